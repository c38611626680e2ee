//! What the viewer draws over a picture must not reach the next picture.

mod common;

use common::{Bench, differing};
use glow::HasContext;
use image::{Rgba, RgbaImage};
use shadowlab::gl::{self, Area, Overlay};
use shadowlab::labs::Show;
use shadowlab::picture::Projection;

const SIZE: [u32; 2] = [161, 120];

/// State that an overlay could leave changed, and a lab does not set before it draws.
fn state(gl: &glow::Context) -> Vec<i32> {
    let mut state: Vec<i32> = [
        glow::DEPTH_TEST,
        glow::STENCIL_TEST,
        glow::SCISSOR_TEST,
        glow::CULL_FACE,
        glow::BLEND,
    ]
    .map(|what| i32::from(unsafe { gl.is_enabled(what) }))
    .to_vec();
    state.extend(
        [
            glow::BLEND_SRC_RGB,
            glow::BLEND_DST_RGB,
            glow::BLEND_SRC_ALPHA,
            glow::BLEND_DST_ALPHA,
            glow::UNPACK_ALIGNMENT,
            glow::ACTIVE_TEXTURE,
            glow::CURRENT_PROGRAM,
            glow::VERTEX_ARRAY_BINDING,
            glow::DRAW_FRAMEBUFFER_BINDING,
        ]
        .map(|what| unsafe { gl.get_parameter_i32(what) }),
    );
    for unit in 0..4 {
        unsafe {
            let active = gl.get_parameter_i32(glow::ACTIVE_TEXTURE) as u32;
            gl.active_texture(glow::TEXTURE0 + unit);
            state.push(gl.get_parameter_i32(glow::TEXTURE_BINDING_2D));
            state.push(gl.get_parameter_i32(glow::SAMPLER_BINDING));
            gl.active_texture(active);
        }
    }
    let mut viewport = [0; 4];
    unsafe { gl.get_parameter_i32_slice(glow::VIEWPORT, &mut viewport) };
    state.extend(viewport);
    state
}

#[test]
fn the_next_picture_is_the_same() {
    // Each setting is a state of its own that the lab leaves behind.
    for settings in [&[][..], &["remedy=culling"], &["shadows=off"]] {
        let mut bench = Bench::new("cs541", SIZE, settings);
        let plain = bench.picture();
        let mut overlay = Overlay::new(&bench.context.gl).unwrap();
        let before = state(&bench.context.gl);

        let gl = &bench.context.gl;
        let sheet = RgbaImage::from_pixel(SIZE[0], SIZE[1], Rgba([255, 0, 255, 128]));
        overlay.set_sheet(gl, &sheet);
        if let Ok(map) = bench.lab.shadow_texture(1) {
            let area = Area {
                left: 100,
                bottom: 7,
                size: [50, 50],
            };
            overlay.draw_inset(
                gl,
                map.texture,
                map.scale.projection,
                [map.scale.near, map.scale.far],
                area,
            );
        }
        overlay.draw_sheet(gl);
        gl::check_errors(gl, "drawing over the picture").unwrap();
        assert_eq!(state(gl), before, "{settings:?}");

        // The control: something was drawn, everywhere.
        let over = gl::read_rgb(gl, SIZE);
        assert!(differing(&plain, &over) > plain.pixels().len() * 9 / 10);
        assert_eq!(differing(&plain, &bench.picture()), 0, "{settings:?}");
    }
}

/// The inset is the picture that `--show shadow-map` writes, in small.
#[test]
fn the_inset_shows_the_map_from_near_to_far() {
    let mut bench = Bench::new("cs541", [256, 256], &["map_size=256"]);
    bench.picture();
    let gl = &bench.context.gl;
    let map = bench.lab.shadow_texture(1).unwrap();
    let expected = gl::read_depths(gl, map.texture, [map.scale.size; 2]).linearised(
        map.scale.projection,
        map.scale.near,
        map.scale.far,
    );
    let overlay = Overlay::new(gl).unwrap();
    let area = Area {
        left: 0,
        bottom: 0,
        size: [256, 256],
    };
    let inset = |planes| {
        overlay.draw_inset(gl, map.texture, map.scale.projection, planes, area);
        gl::read_grey(gl, [256, 256])
    };
    let most = |shown: &image::GrayImage| {
        let pairs = shown.pixels().zip(expected.pixels());
        pairs.map(|(a, b)| a.0[0].abs_diff(b.0[0])).max().unwrap()
    };
    // f32 in the shader, f64 here: the last level may be rounded the other way.
    assert!(most(&inset([map.scale.near, map.scale.far])) <= 1);
    // The control: other planes are another picture.
    assert!(most(&inset([map.scale.near / 2.0, map.scale.far])) > 1);
}

/// Depths of an orthographic map are even already, whatever its planes, of which one may lie behind the light.
#[test]
fn the_inset_of_an_orthographic_map_shows_its_depths() {
    let mut bench = Bench::new("csci3260", [256, 256], &["map_size=256"]);
    bench.picture();
    let gl = &bench.context.gl;
    let map = bench.lab.shadow_texture(1).unwrap();
    let planes = [map.scale.near, map.scale.far];
    assert!(planes[0] < 0.0);
    let depths = gl::read_depths(gl, map.texture, [map.scale.size; 2]);
    let overlay = Overlay::new(gl).unwrap();
    let area = Area {
        left: 0,
        bottom: 0,
        size: [256, 256],
    };
    let wrong = |projection| {
        overlay.draw_inset(gl, map.texture, projection, planes, area);
        let shown = gl::read_grey(gl, [256, 256]).into_raw();
        let expected = depths.depths.iter().map(|depth| 255.0 * depth);
        let apart = expected.zip(shown).map(|(a, b)| (a - f32::from(b)).abs());
        apart.filter(|apart| *apart > 0.51).count()
    };
    assert_eq!(wrong(Projection::Orthographic), 0);
    // The control: taken for one in perspective it is another picture.
    assert!(wrong(Projection::Perspective) > 10_000);
}

/// A lab whose shaders are read again draws the same, and an error changes nothing.
#[test]
fn a_reload_draws_the_same_and_a_failed_one_too() {
    let folder = common::work_folder("reload");
    let file = folder.join("lighting.frag");
    let good = std::fs::read_to_string("glsl/cs541/lighting.frag").unwrap();
    std::fs::write(&file, &good).unwrap();
    let mut bench = Bench::with_glsl("cs541", &folder, SIZE);
    let before = bench.picture();

    std::fs::write(&file, good.replace("void main", "void mian")).unwrap();
    let gl = &bench.context.gl;
    let error = bench.lab.reload(gl).unwrap_err().to_string();
    assert!(error.contains("lighting.frag"), "{error}");
    assert_eq!(differing(&before, &bench.picture()), 0);

    std::fs::write(&file, good.replace("float shadow", "float  shadow")).unwrap();
    bench.lab.reload(&bench.context.gl).unwrap();
    assert_eq!(differing(&before, &bench.picture()), 0);
    bench.lab.render(&bench.context.gl, Show::Picture).unwrap();
}

/// Programs that a reload puts aside are deleted: the driver's next name stays near.
#[test]
fn reloads_leave_no_programs_behind() {
    let folder = common::work_folder("reload-names");
    let file = folder.join("lighting.frag");
    let good = std::fs::read_to_string("glsl/cs541/lighting.frag").unwrap();
    let bad = good.replace("void main", "void mian");
    std::fs::write(&file, &good).unwrap();
    let mut bench = Bench::with_glsl("cs541", &folder, SIZE);
    let alive = |gl: &glow::Context| {
        let native = |id| glow::NativeProgram(std::num::NonZeroU32::new(id).unwrap());
        let shader = |id| glow::NativeShader(std::num::NonZeroU32::new(id).unwrap());
        let is = |&id: &u32| unsafe { gl.is_program(native(id)) || gl.is_shader(shader(id)) };
        (1..1000).filter(is).count()
    };
    bench.picture();
    let before = alive(&bench.context.gl);
    assert!(before > 3);
    for text in [&good, &bad, &good, &bad] {
        std::fs::write(&file, text).unwrap();
        let _ = bench.lab.reload(&bench.context.gl);
        bench.picture();
        assert_eq!(alive(&bench.context.gl), before);
    }
}
