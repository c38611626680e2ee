//! A dump of any length is read in memory that does not grow. Alone in its program: others would share its memory.

mod common;

use std::io::{BufReader, Read};
use std::path::Path;

use common::memory;
use shadowlab::calls;
use shadowlab::progress::Progress;

/// Of the text, in bytes: three hundred times of what may be held.
const LENGTH: usize = 96 << 20;
const MOST_KIB: u64 = 8 * 1024;

/// A dump whose last frame comes again and again, with new objects in each.
struct Repeated {
    frame: String,
    ready: Vec<u8>,
    at: usize,
    count: u64,
    left: usize,
}

impl Read for Repeated {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        if self.at == self.ready.len() {
            if self.left == 0 {
                return Ok(0);
            }
            self.count += 1;
            let id = 1000 + self.count;
            let made = format!(
                "1 glGenTextures(n = 1, textures = &{id})\n\
                 2 glBindTexture(target = GL_TEXTURE_2D, texture = {id})\n\
                 3 glTexImage2D(target = GL_TEXTURE_2D, level = 0, internalformat = GL_RGB, width = 9, height = 9)\n\
                 4 glDeleteTextures(n = 1, textures = &{id})\n\
                 5 glGetUniformLocation(program = 4, name = \"name_{id}\") = -1\n"
            );
            self.ready = (made + &self.frame).into_bytes();
            self.at = 0;
            self.left = self.left.saturating_sub(self.ready.len());
        }
        let length = into.len().min(self.ready.len() - self.at);
        into[..length].copy_from_slice(&self.ready[self.at..self.at + length]);
        self.at += length;
        Ok(length)
    }
}

#[test]
fn a_long_dump_takes_no_more_memory() {
    let text = std::fs::read_to_string(
        Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/dumps/core33.txt"),
    )
    .unwrap();
    let swap = text.find("eglSwapBuffers").unwrap();
    let frame = swap + text[swap..].find('\n').unwrap() + 1;
    let end = frame + text[frame..].find("eglSwapBuffers").unwrap();
    let end = end + text[end..].find('\n').unwrap() + 1;
    let dump = Repeated {
        ready: text.as_bytes()[..frame].to_vec(),
        frame: text[frame..end].to_owned(),
        at: 0,
        count: 0,
        left: LENGTH,
    };

    let before = memory("VmHWM");
    let progress = Progress::new("reading", LENGTH as u64);
    let report = calls::check(
        BufReader::new(dump),
        Path::new("dump.txt"),
        "cs541",
        &progress,
    )
    .unwrap();
    let grown = memory("VmHWM") - before;
    println!("{} frames, {grown} KiB more", report.frames);
    assert!(report.frames > 20_000, "{} frames", report.frames);
    assert!(report.is_clean(), "{}", report.text());
    assert!(grown < MOST_KIB, "{grown} KiB");

    // The control: memory that is held is seen.
    let held = vec![1_u8; 4 * MOST_KIB as usize * 1024];
    assert!(memory("VmHWM") - before > MOST_KIB && held.iter().all(|byte| *byte == 1));
}
