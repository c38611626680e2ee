//! The trace against a driver: what is recorded is what the driver was asked.

use glow::HasContext;
use shadowlab::gl::trace::{self, ObjectKind};
use shadowlab::headless::{Choice, Headless};

fn open(record: bool) -> Headless {
    Headless::open(&Choice::Software, [64, 64], record).unwrap()
}

/// The depth framebuffer, made as the handout makes it, comes back as the handout's text.
#[test]
fn the_text_of_a_depth_framebuffer_is_that_of_the_handout() {
    let gl = &open(true).gl;
    assert_eq!(
        trace::take(),
        [],
        "glow's questions at start are no calls of the lab"
    );
    trace::pass("storing depth values as a texture");
    unsafe {
        let frame_buffer = gl.create_framebuffer().unwrap();
        trace::name_object(
            ObjectKind::Framebuffer,
            frame_buffer.0.get(),
            "frame_buffer",
        );
        gl.bind_framebuffer(glow::FRAMEBUFFER, Some(frame_buffer));
        let texture = gl.create_texture().unwrap();
        gl.bind_texture(glow::TEXTURE_2D, Some(texture));
        gl.tex_image_2d(
            glow::TEXTURE_2D,
            0,
            glow::DEPTH_COMPONENT as i32,
            1024,
            1024,
            0,
            glow::DEPTH_COMPONENT,
            glow::FLOAT,
            glow::PixelUnpackData::Slice(None),
        );
        for filter in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
            gl.tex_parameter_i32(glow::TEXTURE_2D, filter, glow::LINEAR as i32);
        }
        gl.framebuffer_texture_2d(
            glow::FRAMEBUFFER,
            glow::DEPTH_ATTACHMENT,
            glow::TEXTURE_2D,
            Some(texture),
            0,
        );
        // Named last: the lines before must say it too.
        trace::name_object(ObjectKind::Texture, texture.0.get(), "depth_texture_buffer");
        gl.draw_buffer(glow::NONE);
        gl.check_framebuffer_status(glow::FRAMEBUFFER);
        trace::pass("first pass: drawing the shadow map");
        gl.viewport(0, 0, 1024, 1024);
        gl.clear_depth_f64(1.0);
        gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
        gl.bind_framebuffer(glow::FRAMEBUFFER, None);
        gl.get_error();
        gl.delete_framebuffer(frame_buffer);
    }
    assert_eq!(
        trace::to_c(&trace::take()),
        "\
// storing depth values as a texture
glGenFramebuffers(1, &frame_buffer);
glBindFramebuffer(GL_FRAMEBUFFER, frame_buffer);
glGenTextures(1, &depth_texture_buffer);
glBindTexture(GL_TEXTURE_2D, depth_texture_buffer);
glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 1024, 1024, 0, GL_DEPTH_COMPONENT, GL_FLOAT, 0);
glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_texture_buffer, 0);
glDrawBuffer(GL_NONE);
GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);  // GL_FRAMEBUFFER_COMPLETE

// first pass: drawing the shadow map
glViewport(0, 0, 1024, 1024);
glClearDepth(1);
glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
glBindFramebuffer(GL_FRAMEBUFFER, 0);
GLenum error = glGetError();  // GL_NO_ERROR
glDeleteFramebuffers(1, &frame_buffer);
"
    );
}

const VERTEX: &str = "#version 330 core
in vec4 position;
uniform mat4 model_matrix;
void main() { gl_Position = model_matrix * position; }";

const FRAGMENT: &str = "#version 330 core
uniform vec3 colors[2];
out vec4 frag_color;
void main() { frag_color = vec4(colors[0] + colors[1], 1); }";

/// Compiles, draws one triangle over the whole picture and reads a pixel: the shims forward what they record.
#[test]
fn a_triangle_is_drawn_and_every_call_of_it_recorded() {
    let gl = &open(true).gl;
    let mut pixel = [0; 4];
    unsafe {
        let program = gl.create_program().unwrap();
        trace::name_object(ObjectKind::Program, program.0.get(), "program");
        for (kind, source) in [
            (glow::VERTEX_SHADER, VERTEX),
            (glow::FRAGMENT_SHADER, FRAGMENT),
        ] {
            let shader = gl.create_shader(kind).unwrap();
            gl.shader_source(shader, source);
            gl.compile_shader(shader);
            assert!(gl.get_shader_compile_status(shader));
            gl.attach_shader(program, shader);
        }
        gl.bind_attrib_location(program, 0, "position");
        gl.link_program(program);
        assert!(gl.get_program_link_status(program));
        gl.use_program(Some(program));
        let vertices: Vec<u8> = [-1.0f32, -1.0, 3.0, -1.0, -1.0, 3.0]
            .iter()
            .flat_map(|number| number.to_ne_bytes())
            .collect();
        let array = gl.create_vertex_array().unwrap();
        gl.bind_vertex_array(Some(array));
        let buffer = gl.create_buffer().unwrap();
        gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer));
        gl.buffer_data_u8_slice(glow::ARRAY_BUFFER, &vertices, glow::STATIC_DRAW);
        gl.enable_vertex_attrib_array(0);
        gl.vertex_attrib_pointer_f32(0, 2, glow::FLOAT, false, 8, 0);
        let identity = std::array::from_fn::<f32, 16, _>(|i| if i % 5 == 0 { 1.0 } else { 0.0 });
        let matrix = gl.get_uniform_location(program, "model_matrix");
        gl.uniform_matrix_4_f32_slice(matrix.as_ref(), false, &identity);
        let colors = gl.get_uniform_location(program, "colors");
        gl.uniform_3_f32_slice(colors.as_ref(), &[1.0, 0.0, 0.0, 0.0, 0.2, 0.0]);
        gl.draw_arrays(glow::TRIANGLES, 0, 3);
        gl.read_pixels(
            32,
            32,
            1,
            1,
            glow::RGBA,
            glow::UNSIGNED_BYTE,
            glow::PixelPackData::Slice(Some(&mut pixel)),
        );
        // By the name that glow asks for where GL 4.5 is missing.
        let query = gl.create_query().unwrap();
        gl.begin_query(glow::SAMPLES_PASSED, query);
        gl.draw_arrays(glow::TRIANGLES, 0, 3);
        gl.end_query(glow::SAMPLES_PASSED);
        assert_eq!(
            gl.get_query_parameter_u32(query, glow::QUERY_RESULT),
            64 * 64
        );
    }
    assert_eq!(pixel, [255, 51, 0, 255]);
    let text = trace::to_c(&trace::take());
    for line in [
        "GLuint program = glCreateProgram();",
        "glShaderSource(shader_2, 1, &source, &length);",
        "glGetShaderiv(shader_2, GL_COMPILE_STATUS, &value);  // 1",
        "glBindAttribLocation(program, 0, \"position\");",
        "glBufferData(GL_ARRAY_BUFFER, 24, data, GL_STATIC_DRAW);  // 24 bytes",
        "glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 8, 0);",
        "(const GLfloat[]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});  // model_matrix",
        "2, (const GLfloat[]){1, 0, 0, 0, 0.2, 0});  // colors",
        "glDrawArrays(GL_TRIANGLES, 0, 3);",
        "glReadPixels(32, 32, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, data);  // 4 bytes",
        "glGetQueryObjectuiv(query_1, GL_QUERY_RESULT, &value);",
    ] {
        assert!(text.contains(line), "no line {line:?} in\n{text}");
    }
}

/// The arguments that look alike to C and mean different things, each through its real function.
#[test]
fn arguments_are_written_by_their_meaning() {
    let gl = &open(true).gl;
    unsafe {
        gl.depth_func(glow::LEQUAL);
        gl.depth_mask(false);
        gl.blend_func(glow::ONE, glow::ZERO);
        gl.stencil_func(glow::ALWAYS, 1, 0xFF);
        gl.stencil_op(glow::KEEP, glow::ZERO, glow::INCR);
        gl.polygon_offset(1.1, 4.0);
        gl.clear_color(std::f32::consts::FRAC_1_SQRT_2, 0.1, 1e-8, 1.0);
        gl.pixel_store_i32(glow::UNPACK_ALIGNMENT, 1);
        gl.active_texture(glow::TEXTURE1);
        let texture = gl.create_texture().unwrap();
        gl.bind_texture(glow::TEXTURE_2D, Some(texture));
        let pixels = glow::PixelUnpackData::Slice(Some(&[0; 12]));
        let (format, kind) = (glow::RGB, glow::UNSIGNED_BYTE);
        gl.tex_image_2d(
            glow::TEXTURE_2D,
            0,
            glow::RGB8 as i32,
            2,
            2,
            0,
            format,
            kind,
            pixels,
        );
        for (name, value) in [
            (glow::TEXTURE_COMPARE_MODE, glow::NONE),
            (glow::TEXTURE_WRAP_S, glow::CLAMP_TO_BORDER),
            (glow::TEXTURE_MAX_LEVEL, 0),
        ] {
            gl.tex_parameter_i32(glow::TEXTURE_2D, name, value as i32);
        }
        let swizzle = [glow::RED, glow::RED, glow::RED, glow::ONE].map(|name| name as i32);
        gl.tex_parameter_i32_slice(glow::TEXTURE_2D, glow::TEXTURE_SWIZZLE_RGBA, &swizzle);
        let white = [1.0, 1.0, 1.0, 0.5];
        gl.tex_parameter_f32_slice(glow::TEXTURE_2D, glow::TEXTURE_BORDER_COLOR, &white);
        gl.draw_buffers(&[glow::BACK]);
        gl.clear_buffer_f32_slice(glow::COLOR, 0, &white);
        gl.clear_buffer_f32_slice(glow::DEPTH, 0, &[1.0]);
        gl.get_parameter_i32(glow::MAX_TEXTURE_SIZE);
        gl.is_enabled(glow::DEPTH_TEST);
        let array = gl.create_vertex_array().unwrap();
        gl.bind_vertex_array(Some(array));
        let buffer = gl.create_buffer().unwrap();
        gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer));
        gl.buffer_data_size(glow::ARRAY_BUFFER, 96, glow::DYNAMIC_DRAW);
        gl.buffer_sub_data_u8_slice(glow::ARRAY_BUFFER, 4, &[0; 8]);
        gl.vertex_attrib_pointer_f32(1, 3, glow::FLOAT, false, 24, 12);
        gl.bind_buffer(glow::ELEMENT_ARRAY_BUFFER, Some(buffer));
        gl.draw_elements(glow::TRIANGLES, 3, glow::UNSIGNED_INT, 12);
    }
    assert_eq!(
        trace::to_c(&trace::take()),
        "\
glDepthFunc(GL_LEQUAL);
glDepthMask(GL_FALSE);
glBlendFunc(GL_ONE, GL_ZERO);
glStencilFunc(GL_ALWAYS, 1, 0xFF);
glStencilOp(GL_KEEP, GL_ZERO, GL_INCR);
glPolygonOffset(1.1, 4);
glClearColor(0.70710677, 0.1, 1e-8, 1);
glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
glActiveTexture(GL_TEXTURE1);
glGenTextures(1, &texture_1);
glBindTexture(GL_TEXTURE_2D, texture_1);
glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, 2, 2, 0, GL_RGB, GL_UNSIGNED_BYTE, data);  // 12 bytes
glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_NONE);
glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, (const GLint[]){GL_RED, GL_RED, GL_RED, GL_ONE});
glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, (const GLfloat[]){1, 1, 1, 0.5});
glDrawBuffers(1, (const GLenum[]){GL_BACK});
glClearBufferfv(GL_COLOR, 0, (const GLfloat[]){1, 1, 1, 0.5});
glClearBufferfv(GL_DEPTH, 0, (const GLfloat[]){1});
glGetIntegerv(GL_MAX_TEXTURE_SIZE, &value);
GLboolean answer = glIsEnabled(GL_DEPTH_TEST);  // GL_FALSE
glGenVertexArrays(1, &vertex_array_1);
glBindVertexArray(vertex_array_1);
glGenBuffers(1, &buffer_1);
glBindBuffer(GL_ARRAY_BUFFER, buffer_1);
glBufferData(GL_ARRAY_BUFFER, 96, 0, GL_DYNAMIC_DRAW);
glBufferSubData(GL_ARRAY_BUFFER, 4, 8, data);  // 8 bytes
glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 24, (const void *)12);
glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer_1);
glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_INT, (const void *)12);
"
    );
}

/// A pass is a debug group for the driver, and a heading for the record; debug output itself is not recorded.
#[test]
fn debug_groups_go_to_the_driver_unrecorded() {
    let gl = &open(true).gl;
    assert!(gl.supports_debug());
    unsafe {
        gl.push_debug_group(glow::DEBUG_SOURCE_APPLICATION, 0, "first pass");
        gl.finish();
        gl.pop_debug_group();
        assert_eq!(gl.get_error(), glow::NO_ERROR);
    }
    let text = trace::to_c(&trace::take());
    assert_eq!(
        text,
        "glFinish();\nGLenum error = glGetError();  // GL_NO_ERROR\n"
    );
}

/// The control: a call that the record would miss stops the program, although this driver has the function.
#[test]
#[should_panic(expected = "glTexStorage2D")]
fn a_call_that_is_not_traced_stops_the_program() {
    let ask = |context: &Headless| unsafe {
        context
            .gl
            .tex_storage_2d(glow::TEXTURE_2D, 1, glow::RGBA8, 1, 1);
    };
    ask(&open(false));
    ask(&open(true));
}

/// A new context starts a new record, and its objects have no names yet.
#[test]
fn a_new_context_starts_a_new_record() {
    for _ in 0..2 {
        let gl = &open(true).gl;
        unsafe { gl.bind_framebuffer(glow::FRAMEBUFFER, None) };
        trace::name_object(ObjectKind::Buffer, 9, "left over");
        unsafe { gl.bind_buffer(glow::ARRAY_BUFFER, None) };
        let calls = trace::take();
        assert_eq!(calls.len(), 2, "{}", trace::to_c(&calls));
    }
}
