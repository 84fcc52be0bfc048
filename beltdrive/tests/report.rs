//! `report`: one page in HTML with all that stands behind it.

use beltdrive::examples;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::{env, fs};

/// An empty directory for a test.
fn directory(name: &str) -> PathBuf {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("report")
        .join(name);
    let _ = fs::remove_dir_all(&directory);
    fs::create_dir_all(&directory).unwrap();
    directory
}

/// Runs `report` on an example, which stands in the directory as `drive.toml`.
fn report(example: &str, directory: &Path, arguments: &[&str]) -> Output {
    let example = examples::find(example).unwrap();
    fs::write(directory.join("drive.toml"), example.text).unwrap();
    Command::new(env!("CARGO_BIN_EXE_beltdrive"))
        .args(["report", "drive.toml"])
        .args(arguments)
        .current_dir(directory)
        .output()
        .unwrap()
}

#[test]
fn a_page_holds_the_verdict_the_figures_and_the_drive_file() {
    let directory = directory("whole");
    let set = "case.idle.pulley.steering.power=0.2 kW";
    let output = report("serpentine-cases", &directory, &["--set", set]);
    assert_eq!(output.status.code(), Some(3));
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(
        message,
        "wrote drive.html\nerror: 1 of 3 load cases fails\n"
    );
    let page = fs::read_to_string(directory.join("drive.html")).unwrap();
    assert!(page.starts_with("<!DOCTYPE html><html lang=\"en\">") && page.ends_with("</html>"));
    for text in [
        "<h1>Serpentine accessory drive in service</h1>",
        "<p class=\"verdict holds\">cruise: holds</p>",
        "<p class=\"verdict fails\">parking on a hot day: FAILS",
        "<h2>Load case: idle</h2>",
        // With the comments, in which the sources of numbers stand, and their quotes.
        "title = &quot;Serpentine accessory drive in service&quot;",
        "# EA: tension per axial strain",
        "case.idle.pulley.steering.power=0.2 kW",
        "beltdrive report drive.toml --set 'case.idle.pulley.steering.power=0.2 kW'",
        concat!("Made by beltdrive ", env!("CARGO_PKG_VERSION")),
    ] {
        assert!(page.contains(text), "{text}");
    }
    // Three cases, each with the layout and four profiles of a flat belt.
    assert_eq!(page.matches("<figure><svg ").count(), 15);
    assert_eq!(page.matches("</svg>").count(), 15);
}

#[test]
fn a_page_needs_nothing_besides() {
    let directory = directory("alone");
    for example in ["serpentine-cases", "spb-fan", "crossed", "kim2009-bristle"] {
        let output = report(example, &directory, &["--html", "-", "--quiet"]);
        let page = String::from_utf8(output.stdout).unwrap();
        assert!(page.len() > 20_000, "{example}");
        for text in [" src=", " href=", "@import", "url(", "<script"] {
            assert!(!page.contains(text), "{example}: {text}");
        }
        // The name space of SVG is no address that is asked for.
        let addresses = page.replace("http://www.w3.org/2000/svg", "");
        assert!(!addresses.contains("http"), "{example}");
        for tag in [
            "table", "tr", "td", "th", "figure", "section", "pre", "svg", "p",
        ] {
            let opened = page.matches(&format!("<{tag}>")).count()
                + page.matches(&format!("<{tag} ")).count();
            assert_eq!(
                opened,
                page.matches(&format!("</{tag}>")).count(),
                "{example}: {tag}"
            );
        }
    }
}

#[test]
fn a_page_does_not_overwrite_the_drive_file() {
    let directory = directory("kept");
    let output = report("crossed", &directory, &["--html", "drive.toml"]);
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(
        message.contains("would overwrite the drive file"),
        "{message}"
    );
    let text = fs::read_to_string(directory.join("drive.toml")).unwrap();
    assert_eq!(text, examples::find("crossed").unwrap().text);
}

#[test]
fn a_faulty_file_leaves_no_page() {
    let directory = directory("faulty");
    let output = report("crossed", &directory, &["--set", "belt.mass_per_length=-1"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(!directory.join("drive.html").exists());
}

/// Whether a browser reads the page as it was written.
#[test]
#[ignore = "needs a browser: chromium"]
fn a_browser_shows_all_figures() {
    let directory = directory("browser");
    report("serpentine-cases", &directory, &[]);
    let page = directory.join("drive.html");
    let output = Command::new("chromium")
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--dump-dom"])
        .arg(format!(
            "--user-data-dir={}",
            directory.join("profile").display()
        ))
        .arg(format!("file://{}", page.display()))
        .output()
        .unwrap();
    let seen = String::from_utf8(output.stdout).unwrap();
    let written = fs::read_to_string(page).unwrap();
    for tag in [
        "<table", "<tr", "<td", "<figure", "<svg", "<path", "<text", "<section",
    ] {
        assert_eq!(
            seen.matches(tag).count(),
            written.matches(tag).count(),
            "{tag}"
        );
    }
}

#[test]
fn a_page_tells_how_far_numbers_may_be_from_their_values() {
    let directory = directory("uncertain");
    let spread = "uncertainty.friction.coefficient=10 %";
    let arguments = ["--set", spread, "--samples", "20", "--html", "page.html"];
    assert_eq!(
        report("back-side-idler", &directory, &arguments)
            .status
            .code(),
        Some(0)
    );
    let page = fs::read_to_string(directory.join("page.html")).unwrap();
    for text in [
        "95 % from",
        "sampled from",
        "100 % of the samples",
        "--samples 20",
    ] {
        assert!(page.contains(text), "{text}");
    }
}
