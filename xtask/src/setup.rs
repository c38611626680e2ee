//! Set-up: find what a command needs, install it where that may be done, and say in one line what is missing.
//!
//! Nothing here skips a test: without a driver the command stops with exit code 1.

use std::env;
use std::error::Error;
use std::fs;
use std::io::ErrorKind;
use std::process::{Command, ExitCode, Stdio};

use shadowlab::headless;

/// The hidden command that looks for a driver.
pub const PROBE: &str = "probe-driver";

/// What a command cannot run without.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Need {
    /// Any device with an OpenGL 3.3 context: enough for a screenshot.
    AnyDriver,
    /// Mesa's llvmpipe: the golden pictures were drawn with it.
    SoftwareDriver,
    /// The program that writes down GL calls independently of this crate's own trace.
    Apitrace,
    /// What a window loads when it opens.
    WindowLibraries,
    /// An X server without a screen, for the tests of the viewer.
    Xvfb,
    /// The program that presses its keys.
    Xdotool,
}

/// A need that is not met, and what was found in its place.
struct Missing {
    need: Need,
    found: String,
}

/// Returns once all needs are met; installs packages where the system and the user's rights allow it.
pub fn ensure(needs: &[Need]) -> Result<(), Box<dyn Error>> {
    let missing = look(needs)?;
    if missing.is_empty() {
        return Ok(());
    }
    let administrator = if is_debian_like() {
        administrator()
    } else {
        None
    };
    let Some(administrator) = administrator else {
        return Err(without(&missing).into());
    };
    install(&administrator, &packages(&missing, DEBIAN))?;

    let missing = look(needs)?;
    if missing.is_empty() {
        Ok(())
    } else {
        let what = what_is_missing(&missing);
        Err(format!("the packages are installed, and still missing: {what}").into())
    }
}

fn look(needs: &[Need]) -> Result<Vec<Missing>, Box<dyn Error>> {
    let mut missing = Vec::new();
    for &need in needs {
        let found = match need {
            Need::AnyDriver | Need::SoftwareDriver => look_for_driver(need)?,
            Need::Apitrace => look_for_program("apitrace", "version"),
            Need::WindowLibraries => look_for_libraries(),
            Need::Xvfb => look_for_program("Xvfb", "-version"),
            Need::Xdotool => look_for_program("xdotool", "version"),
        };
        if let Err(found) = found {
            missing.push(Missing { need, found });
        }
    }
    Ok(missing)
}

// --- the driver ---

/// Looks in a new process: a process that once failed to load libEGL never tries again, and a driver
/// that crashes takes only that process with it.
fn look_for_driver(need: Need) -> Result<Result<(), String>, Box<dyn Error>> {
    let output = Command::new(env::current_exe()?)
        .args([PROBE, &format!("{need:?}")])
        .stdin(Stdio::null())
        .output()?;
    Ok(match output.status.code() {
        Some(0) => Ok(()),
        Some(1) => Err(String::from_utf8_lossy(&output.stdout).trim().to_owned()),
        _ => Err(format!("looking for one ended with {}", output.status)),
    })
}

/// The other side of [`look_for_driver`]: exit code 0 and nothing to say, or 1 and what was found instead.
pub fn probe(need: &str) -> ExitCode {
    let software_only = need == format!("{:?}", Need::SoftwareDriver);
    let found = match headless::devices() {
        Err(error) => error.to_string(),
        Ok(devices) => {
            let fits = |device: &headless::Device| device.software || !software_only;
            if devices.iter().any(|d| fits(d) && d.version.is_ok()) {
                return ExitCode::SUCCESS;
            }
            describe(&devices)
        }
    };
    println!("{found}");
    ExitCode::from(1)
}

fn describe(devices: &[headless::Device]) -> String {
    if devices.is_empty() {
        return "EGL lists no device".to_owned();
    }
    let one = |device: &headless::Device| {
        let kind = if device.software {
            "software"
        } else {
            "hardware"
        };
        let (Ok(outcome) | Err(outcome)) = &device.version;
        format!("{} ({kind}): {outcome}", device.name)
    };
    devices.iter().map(one).collect::<Vec<_>>().join(", ")
}

// --- programs and libraries ---

/// Whether the program starts; `version` is an argument that lets it end at once.
fn look_for_program(program: &str, version: &str) -> Result<(), String> {
    let ran = Command::new(program)
        .arg(version)
        .stdin(Stdio::null())
        .output();
    match ran {
        Ok(_) => Ok(()),
        Err(cause) if cause.kind() == ErrorKind::NotFound => Err("not on the PATH".to_owned()),
        Err(cause) => Err(cause.to_string()),
    }
}

/// What winit and glutin load by these names, the first ones for X11, the last ones for Wayland.
const LIBRARIES: [&str; 9] = [
    "libX11.so.6",
    "libX11-xcb.so.1",
    "libXcursor.so.1",
    "libXi.so.6",
    "libxkbcommon-x11.so.0",
    "libGL.so.1",
    "libxkbcommon.so.0",
    "libwayland-client.so.0",
    "libwayland-egl.so.1",
];

fn look_for_libraries() -> Result<(), String> {
    // A system without this list has its libraries elsewhere: there the viewer itself says what it misses.
    let Ok(list) = Command::new("/sbin/ldconfig").arg("-p").output() else {
        return Ok(());
    };
    let list = String::from_utf8_lossy(&list.stdout).into_owned();
    let listed = |library: &&str| list.lines().any(|line| line.trim().starts_with(*library));
    let absent: Vec<_> = LIBRARIES
        .into_iter()
        .filter(|library| !listed(library))
        .collect();
    if absent.is_empty() {
        Ok(())
    } else {
        Err(format!("without {}", absent.join(", ")))
    }
}

// --- what to install ---

/// A system's names for the packages of a driver (libEGL, Mesa's half of it, and llvmpipe), of what a window loads, and
/// of the programs that the tests call.
#[derive(Clone, Copy)]
struct System {
    driver: &'static [&'static str],
    window: &'static [&'static str],
    apitrace: &'static str,
    xvfb: &'static str,
    xdotool: &'static str,
}

const DEBIAN: System = System {
    driver: &["libegl1", "libegl-mesa0", "libgl1-mesa-dri"],
    window: &[
        "libx11-6",
        "libx11-xcb1",
        "libxcursor1",
        "libxi6",
        "libxkbcommon-x11-0",
        "libgl1",
        "libglx-mesa0",
        "libwayland-client0",
        "libwayland-egl1",
    ],
    apitrace: "apitrace",
    xvfb: "xvfb",
    xdotool: "xdotool",
};
const FEDORA: System = System {
    driver: &["mesa-libEGL", "mesa-dri-drivers"],
    window: &[
        "libX11",
        "libX11-xcb",
        "libXcursor",
        "libXi",
        "libxkbcommon-x11",
        "mesa-libGL",
        "libwayland-client",
        "libwayland-egl",
    ],
    apitrace: "apitrace",
    xvfb: "xorg-x11-server-Xvfb",
    xdotool: "xdotool",
};
const ARCH: System = System {
    driver: &["mesa", "libglvnd"],
    window: &[
        "libx11",
        "libxcursor",
        "libxi",
        "libxkbcommon-x11",
        "libglvnd",
        "mesa",
        "wayland",
    ],
    apitrace: "apitrace",
    xvfb: "xorg-server-xvfb",
    xdotool: "xdotool",
};

fn packages(missing: &[Missing], system: System) -> Vec<&'static str> {
    let of_one = |missing: &Missing| match missing.need {
        Need::AnyDriver | Need::SoftwareDriver => system.driver.to_vec(),
        Need::Apitrace => vec![system.apitrace],
        Need::WindowLibraries => system.window.to_vec(),
        Need::Xvfb => vec![system.xvfb],
        Need::Xdotool => vec![system.xdotool],
    };
    missing.iter().flat_map(of_one).collect()
}

/// One line: what is missing, and the packages that have it.
fn without(missing: &[Missing]) -> String {
    let names = |system| packages(missing, system).join(" ");
    format!(
        "missing: {}; install on Debian: {}; on Fedora: {}; on Arch: {}",
        what_is_missing(missing),
        names(DEBIAN),
        names(FEDORA),
        names(ARCH)
    )
}

/// What is missing and what was found, on one line whatever a driver put into its message.
fn what_is_missing(missing: &[Missing]) -> String {
    let one = |missing: &Missing| {
        let what = match missing.need {
            Need::AnyDriver => "an OpenGL 3.3 driver that EGL can load",
            Need::SoftwareDriver => "a software OpenGL 3.3 driver (llvmpipe) that EGL can load",
            Need::Apitrace => "the program apitrace",
            Need::WindowLibraries => "the libraries that a window loads",
            Need::Xvfb => "the program Xvfb",
            Need::Xdotool => "the program xdotool",
        };
        let found: Vec<&str> = missing.found.split_whitespace().collect();
        format!("{what} ({})", found.join(" "))
    };
    missing.iter().map(one).collect::<Vec<_>>().join(" and ")
}

// --- installing ---

fn is_debian_like() -> bool {
    fs::read_to_string("/etc/os-release").is_ok_and(|text| names_debian(&text))
}

/// Whether `ID` or `ID_LIKE` of an os-release file names Debian.
fn names_debian(os_release: &str) -> bool {
    os_release
        .lines()
        .filter_map(|line| line.split_once('='))
        .filter(|(key, _)| matches!(*key, "ID" | "ID_LIKE"))
        .flat_map(|(_, value)| value.trim_matches(['"', '\'']).split_whitespace())
        .any(|name| name == "debian")
}

/// The words before a command that let it install packages: none for root, `sudo -n` for who needs no
/// password. None: this user may not.
fn administrator() -> Option<Vec<&'static str>> {
    let output = |words: &[&str]| {
        Command::new(words[0])
            .args(&words[1..])
            .stdin(Stdio::null())
            .output()
            .ok()
    };
    let user = output(&["id", "-u"])?;
    if user.stdout.trim_ascii() == b"0" {
        Some(vec![])
    } else if output(&["sudo", "-n", "true"])?.status.success() {
        Some(vec!["sudo", "-n"])
    } else {
        None
    }
}

fn install(administrator: &[&str], packages: &[&str]) -> Result<(), Box<dyn Error>> {
    eprintln!("xtask: installing {} with apt-get", packages.join(" "));
    let apt_get = |words: &[&str]| {
        // A new machine may still be at its own first installation: wait for it.
        let line = [
            administrator,
            &["env", "DEBIAN_FRONTEND=noninteractive", "LC_ALL=C"],
            &["apt-get", "-qq", "-o", "DPkg::Lock::Timeout=300"],
            words,
        ]
        .concat();
        Command::new(line[0])
            .args(&line[1..])
            .stdin(Stdio::null())
            .output()
    };
    // A list that cannot be had need not be the one with these packages: the installation decides.
    apt_get(&["update"])?;
    let output = apt_get(&[&["install", "-y", "--no-install-recommends"], packages].concat())?;
    if output.status.success() {
        return Ok(());
    }
    let text = String::from_utf8_lossy(&output.stderr);
    let last = text.lines().rfind(|line| !line.trim().is_empty());
    Err(format!(
        "apt-get could not install {}: {}",
        packages.join(" "),
        last.unwrap_or("it gave no reason")
    )
    .into())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn missing(needs: &[Need]) -> Vec<Missing> {
        let one = |&need: &Need| Missing {
            need,
            found: "nothing\nat all".to_owned(),
        };
        needs.iter().map(one).collect()
    }

    #[test]
    fn debian_and_its_kin_are_recognised() {
        assert!(names_debian("NAME=\"Debian GNU/Linux\"\nID=debian\n"));
        assert!(names_debian("ID=ubuntu\nID_LIKE=debian\n"));
        assert!(names_debian("ID=linuxmint\nID_LIKE=\"ubuntu debian\"\n"));
        assert!(!names_debian("ID=fedora\nVERSION_ID=42\n"));
        assert!(!names_debian(
            "ID=arch\nHOME_URL=\"https://example.org/?ID=debian\"\n"
        ));
    }

    #[test]
    fn only_the_packages_of_what_is_missing_are_named() {
        let both = without(&missing(&[Need::SoftwareDriver, Need::Apitrace]));
        assert!(both.contains("libgl1-mesa-dri apitrace"), "{both}");
        assert_eq!(both.lines().count(), 1, "{both}");

        let driver = without(&missing(&[Need::AnyDriver]));
        assert!(driver.contains("on Arch: mesa libglvnd"), "{driver}");
        assert!(!driver.contains("apitrace"), "{driver}");

        let apitrace = without(&missing(&[Need::Apitrace]));
        assert!(apitrace.contains("on Fedora: apitrace"), "{apitrace}");
        assert!(!apitrace.contains("mesa"), "{apitrace}");
    }

    #[test]
    fn a_driver_that_exists_but_fails_is_described() {
        let device = headless::Device {
            name: "llvmpipe".to_owned(),
            software: true,
            version: Err("no 3.3 context".to_owned()),
        };
        assert_eq!(describe(&[device]), "llvmpipe (software): no 3.3 context");
    }
}
