//! The heap of the C library, from which a driver that draws on the CPU takes its memory too.

/// What is free at the heap's end is kept up to this many bytes.
#[cfg(target_env = "gnu")]
const KEPT: libc::c_int = 1 << 28;
/// What is at least this large is not taken from the heap, but from the kernel each time: the most that glibc allows.
#[cfg(target_env = "gnu")]
const TOO_LARGE: libc::c_int = 1 << 25;

/// Keeps what is given back. For a frame of 200,000 triangles Mesa's software renderer takes some 30 MB and gives them
/// back at its end. glibc would hand them on to the kernel, which clears every page again as soon as it is touched: that
/// is up to a third of such a frame.
pub fn keep_heap() {
    #[cfg(target_env = "gnu")]
    unsafe {
        libc::mallopt(libc::M_TRIM_THRESHOLD, KEPT);
        libc::mallopt(libc::M_MMAP_THRESHOLD, TOO_LARGE);
    }
}
