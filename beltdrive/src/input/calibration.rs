//! Which numbers of a drive file a calibration finds.

use super::{
    Argument, Diagnostic, DriveFile, FileKey, check,
    diagnostic::Finding,
    document::{Content, Entry},
    schema::CALIBRATED,
    spelling,
};

impl DriveFile {
    /// The numbers of the file that a calibration finds: those that options `--free` name, or without any those of
    /// `calibration.free`.
    ///
    /// # Errors
    /// A key is none of a number of the file or stands twice, or there is none.
    pub fn free_keys(&self, named: &[String]) -> Result<Vec<FileKey>, Diagnostic> {
        if named.is_empty() {
            let keys = self.calibrated();
            return keys.map_err(|finding| Diagnostic::new(finding, &self.source));
        }
        let mut keys: Vec<FileKey> = Vec::new();
        for value in named {
            let option = "--free";
            let argument = Argument { option, value };
            let key = self.key(argument)?;
            if keys.contains(&key) {
                let finding = Finding::new(argument.entry().place, twice(&key));
                return Err(argument.diagnose(finding));
            }
            keys.push(key);
        }
        Ok(keys)
    }

    fn calibrated(&self) -> Result<Vec<FileKey>, Finding> {
        let entry = self.document.entries.get(CALIBRATED);
        let texts = entry.map(|entry| &entry.content);
        let Some(Content::List(texts)) = texts else {
            let end = self.document.end.clone();
            let message = "nothing says which numbers are to be found";
            return Err(Finding::new(end, message)
                .expected("--free KEY, or free = [\"friction.coefficient\"] in [calibration]"));
        };
        let known = self.keys();
        let paths = || known.iter().map(FileKey::path);
        let mut keys: Vec<FileKey> = Vec::new();
        for Entry { place, content, .. } in texts {
            let Content::Text(path) = content else {
                continue;
            };
            let Some(key) = known.iter().find(|key| key.path() == path) else {
                let message = format!("the drive file gives no number `{path}`");
                return Err(Finding::new(place.clone(), message)
                    .expected(check::one_of(&paths().collect::<Vec<_>>()))
                    .did_you_mean(spelling::nearest_key(path, paths)));
            };
            if keys.contains(key) {
                return Err(Finding::new(place.clone(), twice(key)));
            }
            keys.push(key.clone());
        }
        Ok(keys)
    }
}

fn twice(key: &FileKey) -> String {
    format!("`{}` stands twice", key.path())
}
