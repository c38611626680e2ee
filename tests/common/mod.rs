//! What the tests share: a lab in a context on the software renderer, brought to a state.
#![allow(dead_code)]

use image::DynamicImage;
use shadowlab::gl;
use shadowlab::headless::{Choice, Headless};
use shadowlab::labs::{self, Lab, Show, parse_keys};
use shadowlab::scene::Scene;

pub struct Bench {
    pub lab: Box<dyn Lab>,
    pub context: Headless,
    pub size: [u32; 2],
}

impl Bench {
    pub fn new(lab: &str, size: [u32; 2], settings: &[&str]) -> Self {
        let scene = (labs::find(lab).unwrap().scene)().unwrap();
        Self::with_scene(lab, scene, size, settings)
    }

    pub fn with_scene(lab: &str, scene: Scene, size: [u32; 2], settings: &[&str]) -> Self {
        let context = Headless::open(&Choice::Software, size, false).unwrap();
        Self::start(lab, scene, None, context, size, settings)
    }

    /// The same with every GL call recorded.
    pub fn recorded(lab: &str, size: [u32; 2], settings: &[&str]) -> Self {
        let scene = (labs::find(lab).unwrap().scene)().unwrap();
        Self::recorded_with_scene(lab, scene, size, settings)
    }

    pub fn recorded_with_scene(lab: &str, scene: Scene, size: [u32; 2], settings: &[&str]) -> Self {
        let context = Headless::open(&Choice::Software, size, true).unwrap();
        Self::start(lab, scene, None, context, size, settings)
    }

    /// With a student's own shaders.
    pub fn with_glsl(lab: &str, folder: &std::path::Path, size: [u32; 2]) -> Self {
        let scene = (labs::find(lab).unwrap().scene)().unwrap();
        let context = Headless::open(&Choice::Software, size, false).unwrap();
        Self::start(lab, scene, Some(folder), context, size, &[])
    }

    /// With a student's own shaders, and a scene.
    pub fn with_scene_and_glsl(
        lab: &str,
        scene: Scene,
        folder: &std::path::Path,
        size: [u32; 2],
        settings: &[&str],
    ) -> Self {
        let context = Headless::open(&Choice::Software, size, false).unwrap();
        Self::start(lab, scene, Some(folder), context, size, settings)
    }

    fn start(
        lab: &str,
        scene: Scene,
        glsl: Option<&std::path::Path>,
        context: Headless,
        size: [u32; 2],
        settings: &[&str],
    ) -> Self {
        let mut lab = (labs::find(lab).unwrap().start)(&context.gl, scene, glsl).unwrap();
        lab.resize(size);
        let mut bench = Self { lab, context, size };
        bench.set(settings);
        bench
    }

    pub fn set(&mut self, settings: &[&str]) {
        for assignment in settings {
            self.lab.settings().set(assignment).unwrap();
        }
    }

    pub fn press(&mut self, keys: &str) {
        for input in parse_keys(keys).unwrap() {
            assert!(self.lab.input(input.clone()), "no key {input}");
        }
    }

    pub fn picture(&mut self) -> image::RgbImage {
        self.draw(Show::Picture);
        gl::read_rgb(&self.context.gl, self.size)
    }

    pub fn visibility(&mut self) -> image::GrayImage {
        self.visibility_of(1)
    }

    pub fn visibility_of(&mut self, light: usize) -> image::GrayImage {
        self.draw(Show::Visibility { light });
        gl::read_grey(&self.context.gl, self.size)
    }

    /// None where the state draws no map.
    pub fn map_scale(&self) -> Option<labs::MapScale> {
        self.lab.shadow_texture(1).ok().map(|map| map.scale)
    }

    /// A frame, and nothing else that would be in the record.
    pub fn render(&mut self) {
        self.lab.render(&self.context.gl, Show::Picture).unwrap();
    }

    fn draw(&mut self, show: Show) {
        self.lab.render(&self.context.gl, show).unwrap();
        gl::check_errors(&self.context.gl, "drawing").unwrap();
    }
}

/// The same numbers on every machine and in every run: a 64-bit linear congruential generator.
pub struct Random(pub u64);

impl Random {
    /// Less than `end`.
    pub fn below(&mut self, end: u32) -> u32 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % u64::from(end)) as u32
    }
}

/// What a comparison forgives, per channel: llvmpipe compiles for the processor it runs on, and where that one has other
/// instructions a colour may be rounded the other way.
pub const LEVELS: u8 = 2;
/// The share of pixels that may differ by more: those of triangles' and shadows' edges, which the same rounding can
/// move. Measured with SSE4.1 alone against AVX-512: at most 0.012 %.
pub const SHARE_BEYOND: f64 = 0.0005;
/// What is wrong with a picture, in a line.
pub fn compare(
    expected: &DynamicImage,
    drawn: &DynamicImage,
    share_beyond: f64,
) -> Result<(), String> {
    if expected.color() != drawn.color() {
        return Err(format!(
            "{:?}, expected {:?}",
            drawn.color(),
            expected.color()
        ));
    }
    let (expected, drawn) = (expected.to_rgb8(), drawn.to_rgb8());
    if expected.dimensions() != drawn.dimensions() {
        let (found, wanted) = (drawn.dimensions(), expected.dimensions());
        return Err(format!("{found:?} pixels, expected {wanted:?}"));
    }
    let pairs = expected.pixels().zip(drawn.pixels());
    let beyond = pairs
        .filter(|(a, b)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > LEVELS))
        .count();
    let share = beyond as f64 / f64::from(expected.width() * expected.height());
    if share > share_beyond {
        return Err(format!(
            "{beyond} pixels differ by more than {LEVELS} levels"
        ));
    }
    Ok(())
}

/// How many pixels differ at all.
pub fn differing<P: image::Pixel>(
    a: &image::ImageBuffer<P, Vec<P::Subpixel>>,
    b: &image::ImageBuffer<P, Vec<P::Subpixel>>,
) -> usize
where
    P::Subpixel: PartialEq,
{
    assert_eq!(a.dimensions(), b.dimensions());
    let pairs = a.pixels().zip(b.pixels());
    pairs.filter(|(a, b)| a.channels() != b.channels()).count()
}

/// An empty folder of a test's own, under the build's folder.
pub fn work_folder(name: &str) -> std::path::PathBuf {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

impl Bench {
    /// The default state's visibility, at the size that most tests have.
    pub fn default_visibility() -> image::GrayImage {
        Self::new("cs541", [320, 240], &[]).visibility()
    }
}

/// What Linux says of this process's memory, in KiB: `VmRSS` is resident now, `VmHWM` the most so far.
pub fn memory(what: &str) -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find(|line| line.starts_with(what)).unwrap();
    line.split_whitespace().nth(1).unwrap().parse().unwrap()
}
