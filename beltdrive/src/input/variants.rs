//! Drive files that differ from one in some of its numbers, read many times.

use super::{
    Diagnostic, DriveFile, FileKey, check,
    document::{Content, Entry},
    file,
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
        let varied = keys.iter().map(entry).collect();
        Ok(Self {
            file,
            values,
            varied,
        })
    }

    /// The drive with these values of the numbers, SI, in their order.
    ///
    /// # Errors
    /// As [`DriveFile::drive`] of the file with these values.
    pub fn drive(&self, numbers: impl IntoIterator<Item = f64>) -> Result<Drive, Diagnostic> {
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
            for (index, key) in keys.iter().enumerate() {
                for factor in [1.01, -1.0, 0.0, 1e6] {
                    let mut numbers = given.clone();
                    numbers[index] *= factor;
                    let expected = file.with(key, numbers[index]).drive();
                    let found = variants.drive(numbers);
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
}
