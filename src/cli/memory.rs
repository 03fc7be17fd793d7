//! What the allocator keeps.

/// Blocks of so many bytes and more are mapped, and given back as soon as they are free. Derived:
/// what glibc begins with.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const MAPPED: libc::c_int = 128 * 1024;

/// Keeps glibc from holding on to large blocks: it takes what is as large as the largest block that
/// was freed so far, up to 32 MiB, from a heap where it stays between others.
///
/// Measured with glibc 2.36: the peak of isolating 84 500 features falls from 308 to 229 MiB, those
/// of milling boards of the corpus by a tenth to a fifth, and the time is the same.
pub(super) fn give_back_large_blocks() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    #[expect(unsafe_code, reason = "no crate has a safe way to set what glibc maps")]
    // SAFETY: it sets a number that the allocator reads, which glibc allows at any time.
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, MAPPED);
    }
}
