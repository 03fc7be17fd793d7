//! What a process has used of the machine so far, as Linux counts it; none where a system does not
//! say.

use std::path::PathBuf;

/// CPU seconds of all threads of the process. Rayon's threads live as long as it does.
#[allow(dead_code, reason = "not every benchmark needs it")]
pub(crate) fn cpu_seconds() -> Option<f64> {
    cpu_seconds_of("self")
}

/// The same of a process by its number.
#[allow(dead_code, reason = "not every benchmark needs it")]
pub(crate) fn cpu_seconds_of(process: &str) -> Option<f64> {
    let threads = std::fs::read_dir(format!("/proc/{process}/task")).ok()?.flatten();
    let spent = |path: PathBuf| {
        let told = std::fs::read_to_string(path.join("schedstat")).ok()?;
        told.split_whitespace().next()?.parse::<f64>().ok()
    };
    Some(threads.filter_map(|thread| spent(thread.path())).sum::<f64>() / 1e9)
}

/// Peak resident memory of the process, in MiB.
#[allow(dead_code, reason = "not every benchmark needs it")]
pub(crate) fn peak_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse::<f64>().ok().map(|kib| kib / 1024.0)
}
