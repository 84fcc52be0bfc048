//! A speed without a unit that was hardly meant in rad/s.

use super::{DriveFile, document::Content, quantity};
use crate::quantity::precision::six_digits;
use crate::{Drive, Duty};

/// Belt speed above which a bare number is taken for one in rpm, m/s: catalogues rate V-belts up to 30 to 50 m/s, and
/// most flat belts up to 60 m/s.
const FASTEST: f64 = 60.0;

impl DriveFile {
    /// What to look at if the drive has no steady state and its speed is a bare number that makes the belt faster than
    /// usual.
    pub fn bare_speed(&self) -> Option<String> {
        let drive = self.drive().ok()?;
        let belt_speed = drive.rim_speed();
        let [path, number] = self.bare_number(&drive)?;
        (belt_speed > FASTEST).then(|| {
            format!(
                "`{path}` has no unit: it is {number} rad/s, at which the belt runs at {} m/s; write \"{number} rpm\" \
                 if that is meant",
                six_digits(belt_speed)
            )
        })
    }

    /// The key of the speed and its number, if it has no unit.
    fn bare_number(&self, drive: &Drive) -> Option<[String; 2]> {
        let driver = drive.pulleys.iter();
        let driver = { driver }.find(|pulley| matches!(pulley.duty, Duty::Driver(_)))?;
        let paths = ["pulley", "pulleys"].map(|table| format!("{table}.{}.speed", driver.name));
        let given = |path: String| self.document.entries.get_key_value(&path);
        let (path, entry) = paths.into_iter().find_map(given)?;
        let number = match &entry.content {
            Content::Number(number) => six_digits(*number),
            Content::Text(text)
                if quantity::parse(text).is_ok_and(|found| found.unit.is_none()) =>
            {
                text.trim().to_owned()
            }
            _ => return None,
        };
        Some([path.clone(), number])
    }
}
