//! A large model within the memory that is promised.

use crate::support::models::folder;
use serde_json::Value;
use std::io::Write;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// Bytes of the process, at most, for 99,000 patches against themselves.
const MAX_BYTES: u64 = 1 << 30;

/// How often the system is queried for the process' peak so far.
const INTERVAL: Duration = Duration::from_millis(5);

/// The largest resident size of the process so far, once the system knows it.
fn peak_bytes(process: u32) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kibibytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kibibytes << 10)
}

#[test]
fn a_terrain_of_99_000_patches_fits_a_gibibyte() {
    let test = "a_terrain_of_99_000_patches_fits_a_gibibyte";
    let Some(folder) = folder(test) else { return };
    let terrain = folder.join("occt_terrain.json");
    let mut run = Command::new(env!("CARGO_BIN_EXE_nurbs-hausdorff"))
        .args(["distance", "--method", "iteration", "--backend", "gpu", "--translate=30,20,50", "--json"])
        .args([&terrain, &terrain])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut peak = 0;
    while run.try_wait().unwrap().is_none() {
        peak = peak_bytes(run.id()).unwrap_or(0).max(peak);
        sleep(INTERVAL);
    }
    let output = run.wait_with_output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    if errors.contains("NO_ADAPTER") && std::env::var_os("NURBS_HAUSDORFF_ALLOW_NO_GPU").is_some() {
        std::io::stderr().write_all(format!("\nSKIPPED {test}: {errors}\n").as_bytes()).unwrap();
        return;
    }
    assert!(output.status.success(), "{errors}");
    let result: Value = serde_json::from_slice(&output.stdout).unwrap();
    println!("peak {} MiB, seconds {}", peak >> 20, result["seconds"]);
    assert!(result["patches"]["a"].as_u64().unwrap() > 98_000);
    // Whatever is moved is as far from where it was as it was moved: its
    // extreme point in that direction is, and no point is farther.
    let moved = (30.0_f64 * 30.0 + 20.0 * 20.0 + 50.0 * 50.0).sqrt();
    let number = |name: &str| result[name].as_f64().unwrap();
    let rounding = 1e-12 * number("diagonal");
    assert!(number("lower") <= moved + rounding && moved - rounding <= number("upper"), "{result}");
    assert!(number("computed") <= moved + rounding, "{result}");
    assert!(peak > 0 && peak < MAX_BYTES, "{peak} bytes");
}
