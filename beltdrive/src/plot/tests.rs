use super::*;
use crate::quantity::{branch, limit_curve, two_pulleys};
use crate::report::{sample, sample_branch, sample_flat};

/// A directory of this process that is gone after the test.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let name = format!("beltdrive-plot-{name}-{}", std::process::id());
        Self(std::env::temp_dir().join(name))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        drop(fs::remove_dir_all(&self.0));
    }
}

/// The attribute of a tag.
fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = tag.split_once(&format!(" {name}=\""))?;
    rest.split_once('"').map(|(value, _)| value)
}

/// Every element that begins ends, every number is one, and every text is on the sheet, its numbers with
/// minus signs.
pub(super) fn check(figure: &str) {
    assert!(figure.starts_with("<svg") && figure.ends_with("</svg>\n"));
    assert!(!figure.contains("NaN") && !figure.contains("inf\""));
    let number = |tag, name| attribute(tag, name).and_then(|text| text.parse::<f64>().ok());
    let mut open: Vec<&str> = Vec::new();
    let sheet = figure.split_once('>').unwrap().0;
    let [width, height] = ["width", "height"].map(|name| number(sheet, name).unwrap());
    for element in figure.split('<').skip(1) {
        let (tag, text) = element.split_once('>').expect("a tag ends");
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name));
        } else if !tag.ends_with('/') {
            assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
            open.extend(tag.split_whitespace().next());
        }
        if tag.starts_with("text") {
            let [x, y, size] = ["x", "y", "font-size"].map(|name| number(tag, name).unwrap());
            let length = sheet::text_width(text, size);
            let start = match attribute(tag, "text-anchor") {
                Some("start") => x,
                Some("middle") => x - 0.5 * length,
                _ => x - length,
            };
            let is_turned = tag.contains("rotate(-90)");
            let ends = if is_turned {
                [-start - length, -start]
            } else {
                [start, start + length]
            };
            let [along, across] = if is_turned {
                [height, width]
            } else {
                [width, height]
            };
            assert!(
                ends[0] >= 0.0 && ends[1] <= along,
                "{text} from {ends:?} on {along}"
            );
            assert!(
                y - size >= 0.0 && y + 0.3 * size <= across,
                "{text} at {y} on {across}"
            );
            let letters: Vec<_> = text.chars().collect();
            let is_minus = |trio: &[char]| {
                !trio[0].is_alphanumeric() && trio[1] == '-' && trio[2].is_ascii_digit()
            };
            assert!(
                !letters.windows(3).any(is_minus) && !text.starts_with('-'),
                "{text}"
            );
        }
    }
    assert_eq!(open, [""; 0]);
}

fn names(files: &[PathBuf]) -> Vec<&str> {
    let names = files.iter().map(|file| file.file_name().unwrap());
    names.map(|name| name.to_str().unwrap()).collect()
}

fn state(state: &crate::SteadyState, directory: &Path) -> Result<Vec<PathBuf>, Error> {
    write_state(&two_pulleys::drawn(state), "drive.svg", directory, None)
}

#[test]
fn every_figure_is_written_and_well_formed() {
    let scratch = Scratch::new("figures");
    for (name, drawn) in [
        ("loaded", sample::loaded()),
        ("idle", sample::idle()),
        ("overhanging", sample::overhanging()),
        ("blank", sample::blank()),
    ] {
        let files = state(&drawn, &scratch.0.join(name)).unwrap();
        let expected = [
            "drive.svg",
            "tension.svg",
            "inclination.svg",
            "penetration.svg",
            "sliding_angle.svg",
            "normal_and_friction_force.svg",
        ];
        assert_eq!(names(&files), expected);
        for file in files {
            let text = fs::read_to_string(&file).unwrap();
            check(&text);
            let warns = text.contains(">Warning: the belt overhangs itself on the driver");
            assert_eq!(warns, name == "overhanging");
        }
    }
}

#[test]
fn a_flat_belt_has_its_own_figures() {
    let scratch = Scratch::new("flat");
    for drawn in [
        sample_flat::epp(),
        sample_flat::coulomb(),
        sample_flat::creep(),
    ] {
        let mut files = state(&drawn, &scratch.0).unwrap();
        let expected = [
            "drive.svg",
            "tension.svg",
            "friction_force.svg",
            "normal_force.svg",
            "displacement.svg",
        ];
        assert_eq!(names(&files), expected);
        let branch = branch::answer(&sample_flat::branch());
        files.extend(write_rows(&branch, "branch.svg", &scratch.0, None).unwrap());
        let curve = limit_curve::answer(&sample_flat::curve());
        files.extend(write_rows(&curve, "limit_curve.svg", &scratch.0, None).unwrap());
        for file in files {
            let text = fs::read_to_string(&file).unwrap();
            check(&text);
            assert!(text.contains("normal force n = (T − G V)/R"));
            for word in ["nclination", "enetration", "groove", "V-belt"] {
                assert!(!text.contains(word), "{word} in {}", file.display());
            }
        }
        let branch = fs::read_to_string(scratch.0.join("branch.svg")).unwrap();
        assert!(branch.contains(">Slip arc<"));
    }
}

#[test]
fn every_stability_has_figures() {
    let scratch = Scratch::new("stability");
    let stability = crate::quantity::stability::sample::stability();
    let files = write_stability(&stability, &scratch.0, Some("a < b")).unwrap();
    assert_eq!(names(&files), ["modes.svg", "spectrum.svg"]);
    for file in files {
        let text = fs::read_to_string(file).unwrap();
        check(&text);
        assert!(text.contains("\n<metadata>a &lt; b</metadata>"));
    }
}

#[test]
fn a_directory_that_cannot_be_created_is_named() {
    let scratch = Scratch::new("blocked");
    fs::write(&scratch.0, "a file").unwrap();
    let error = state(&sample::loaded(), &scratch.0.join("figures")).unwrap_err();
    fs::remove_file(&scratch.0).unwrap();
    assert!(matches!(&error, Error::Directory { path, .. } if path.ends_with("figures")));
    assert!(error.to_string().contains("blocked"));
}

#[test]
fn a_figure_that_cannot_be_written_is_named() {
    let scratch = Scratch::new("occupied");
    fs::create_dir_all(scratch.0.join("drive.svg")).unwrap();
    let error = state(&sample::loaded(), &scratch.0).unwrap_err();
    assert!(matches!(&error, Error::Figure { path, .. } if path.ends_with("drive.svg")));
}

#[test]
fn an_empty_answer_has_figures() {
    let mut branch = sample_branch::folded();
    branch.points.clear();
    branch.events.clear();
    check(&rows::figure(&branch::answer(&branch)));
    profiles::figures(&Answer::default()).for_each(|(_, figure)| check(&figure));
}
