//! Drive files that differ from one in some of its numbers, read many times.

use super::{
    Diagnostic, DriveFile, FileKey, check,
    document::{Content, Entry},
    file, section,
    values::Values,
};
use crate::Drive;

/// The drives of a file with other values of some of its numbers. All other entries are checked once, so that a drive
/// takes a fraction of the time of [`DriveFile::with`] and [`DriveFile::drive`].
#[derive(Clone, Debug)]
pub struct Variants<'f> {
    file: &'f DriveFile,
    values: Values<'f>,
    /// The path and the entry of each number.
    varied: Vec<(&'f str, &'f Entry)>,
    /// Whether other entries follow from these numbers by the belt section.
    is_followed: bool,
}

impl<'f> Variants<'f> {
    /// The drives with other values of numbers of a file.
    ///
    /// # Errors
    /// An entry of the file is at fault.
    ///
    /// # Panics
    /// If a number is none of the file.
    pub fn new(file: &'f DriveFile, keys: &[&FileKey]) -> Result<Self, Diagnostic> {
        let values = Values::check(&file.document, &file.source);
        let values = values.map_err(|finding| Diagnostic::new(finding, &file.source))?;
        let entry = |key: &&FileKey| {
            let entries = &file.document.entries;
            let (path, entry) = entries
                .get_key_value(key.path())
                .expect("a number of the file");
            (path.as_str(), entry)
        };
        let varied: Vec<_> = keys.iter().map(entry).collect();
        let has_section = file.filled_in.is_some();
        Ok(Self {
            file,
            values,
            is_followed: has_section && varied.iter().any(|(path, _)| section::is_followed(path)),
            varied,
        })
    }

    /// The drive with these values of the numbers, SI, in their order.
    ///
    /// # Errors
    /// As [`DriveFile::drive`] of the file with these values.
    pub fn drive(&self, numbers: impl IntoIterator<Item = f64>) -> Result<Drive, Diagnostic> {
        if self.is_followed {
            let contents = self.varied.iter().zip(numbers);
            let contents =
                contents.map(|((path, _), number)| ((*path).to_owned(), Content::Number(number)));
            return self.file.restated(contents).drive();
        }
        let mut values = self.values.clone();
        let source = &self.file.source;
        let diagnosed = |finding| Diagnostic::new(finding, source);
        for (&(path, entry), number) in self.varied.iter().zip(numbers) {
            let entry = Entry {
                content: Content::Number(number),
                ..entry.clone()
            };
            let number = check::quantity(path, &entry, source).map_err(diagnosed)?;
            values.set_number(path, number);
        }
        file::drive(&values).map_err(diagnosed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BeltKind;
    use crate::examples::EXAMPLES;

    #[test]
    fn a_variant_is_the_file_with_another_number() {
        for example in EXAMPLES {
            let file = DriveFile::read(example.name, example.text, &[]).unwrap();
            let keys = file.keys();
            let keys: Vec<_> = keys.iter().collect();
            let given: Vec<_> = keys.iter().map(|key| file.value(key).unwrap()).collect();
            let variants = Variants::new(&file, &keys).unwrap();
            assert_eq!(variants.drive(given.clone()), file.drive());
            for (key, given) in keys.iter().zip(given) {
                let variants = Variants::new(&file, &[key]).unwrap();
                for factor in [1.01, -1.0, 0.0, 1e6] {
                    let expected = file.with(key, factor * given).drive();
                    let found = variants.drive([factor * given]);
                    // Of a fault the message is the same, its excerpt may be that of another entry.
                    let message = |error: Diagnostic| error.message().to_owned();
                    assert_eq!(
                        found.map_err(message),
                        expected.map_err(message),
                        "{} {} {factor}",
                        example.name,
                        key.path()
                    );
                }
            }
        }
    }

    #[test]
    fn what_a_section_gives_follows_from_a_number_that_varies() {
        let text = crate::examples::find("spb-fan").unwrap().text;
        let read = |overrides: &[&str]| {
            let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
            DriveFile::read("spb-fan.toml", text, &overrides).unwrap()
        };
        let file = read(&[]);
        let keys = file.keys();
        let find = |path| keys.iter().find(|key| key.path() == path).unwrap();
        let drive = |key, value| {
            let variants = Variants::new(&file, &[key]).unwrap();
            variants.drive([value]).unwrap()
        };
        // The grooves of SPB pulleys of more than 190 mm are wider.
        let diameter = find("pulleys.driver.diameter");
        let wider = read(&["pulleys.driver.diameter=200 mm"]).drive().unwrap();
        assert_eq!(drive(diameter, 0.2), wider);
        assert_eq!(wider.pulleys[1].half_angle, None);
        // A number that the section gave changes for itself, and is what it is whatever changes after it.
        for (path, value) in [
            ("groove.half_angle", 0.35),
            ("pulleys.driven.half_angle", 0.35),
            ("belt.axial_stiffness", 2e5),
        ] {
            let key = find(path);
            let mut expected = file.drive().unwrap();
            match (path, &mut expected.belt.kind) {
                ("groove.half_angle", BeltKind::V(belt)) => belt.half_angle = value,
                ("belt.axial_stiffness", _) => expected.belt.axial_stiffness = value,
                _ => expected.pulleys[1].half_angle = Some(value),
            }
            let other = file.with(key, value);
            assert_eq!(other.drive().unwrap(), expected, "{path}");
            assert_eq!(drive(key, value), expected, "{path}");
            let (there, back) = (0.2, file.value(diameter).unwrap());
            let moved = other.with(diameter, there);
            assert_eq!(moved.value(key), Some(value), "{path}");
            assert_eq!(
                moved.with(diameter, back).drive().unwrap(),
                expected,
                "{path}"
            );
        }
    }
}
