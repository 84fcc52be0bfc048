//! The service of a drive: its load cases, each as the drive file with another load, and its requirements.

use super::{
    Diagnostic, DriveFile, check,
    diagnostic::Finding,
    document::{Content, Document, Entry},
    overrides, schema,
    values::Values,
};
use crate::{BendingLoss, Drive, GivenLosses, LoadCase, Requirements, Service};

/// By how much the shares of all cases may differ from 1 in sum: shares with six digits.
const ROUNDED: f64 = 1e-6;

/// Keys of a load case that stand for keys of the drive.
const LOADS: [&str; 3] = ["torque", "power", "speed"];

impl DriveFile {
    /// Whether the file has load cases.
    pub(crate) fn has_cases(&self) -> bool {
        !self.document.cases.is_empty()
    }

    /// The service of the drive: the load cases of the file, or the drive as it stands where it has none, with the
    /// requirements and the given losses.
    ///
    /// # Errors
    /// As [`super::parse`], of the drive in each case; the shares of the cases do not add up to 1, or only some
    /// cases have one; a case has a load for a pulley that there is not.
    pub fn service(&self) -> Result<Service, Diagnostic> {
        let diagnosed = |finding| Diagnostic::new(finding, &self.source);
        let values = Values::check(&self.document, &self.source).map_err(diagnosed)?;
        let shares = shares(&values, &self.document.cases).map_err(diagnosed)?;
        let cases = self.document.cases.iter().zip(shares);
        let cases = cases.map(|(name, share)| {
            Ok(LoadCase {
                name: name.clone(),
                share,
                drive: self.in_case(name)?,
            })
        });
        let mut cases = cases.collect::<Result<Vec<_>, Diagnostic>>()?;
        if cases.is_empty() {
            cases.push(LoadCase {
                name: "as stated".to_owned(),
                share: None,
                drive: self.drive()?,
            });
        }
        Ok(Service {
            cases,
            requirements: Requirements {
                smallest_slip_margin: values.number("requirements.smallest_slip_margin"),
                largest_speed_loss: values.number("requirements.largest_speed_loss"),
                largest_hub_load: values.number("requirements.largest_hub_load"),
                largest_tension: values.number("requirements.largest_tension"),
            },
            given_losses: given_losses(&values).map_err(diagnosed)?,
        })
    }

    /// The drive in a load case.
    fn in_case(&self, name: &str) -> Result<Drive, Diagnostic> {
        let mut file = self.clone();
        loaded(&mut file.document, name)
            .map_err(|finding| Diagnostic::new(finding, &self.source))?;
        file.drive()
    }
}

/// The share of each case, where they have one.
fn shares(values: &Values<'_>, cases: &[String]) -> Result<Vec<Option<f64>>, Finding> {
    let path = |case: &String| format!("case.{case}.share");
    let shares: Vec<_> = cases
        .iter()
        .map(|case| values.number(&path(case)))
        .collect();
    let given = || shares.iter().flatten();
    if given().next().is_none() {
        return Ok(shares);
    }
    if let Some(without) = shares.iter().position(Option::is_none) {
        let case = &cases[without];
        let place = values.key_place(&format!("case.{case}"));
        let message =
            format!("the load case `{case}` has no share of the time, but others have one");
        return Err(
            Finding::new(place, message).expected("a `share` in every [[case]], or in none")
        );
    }
    let sum: f64 = given().sum();
    if (sum - 1.0).abs() > ROUNDED {
        let last = cases.last().map(path).unwrap_or_default();
        let message = format!(
            "the shares of the load cases add up to {}, not to 1",
            rounded(sum)
        );
        return Err(Finding::new(values.place(&last), message)
            .expected("shares of the time, such as \"20 %\", that add up to 100 %"));
    }
    Ok(shares)
}

/// A sum of shares for a message.
fn rounded(sum: f64) -> f64 {
    (sum / ROUNDED).round() * ROUNDED
}

/// Puts the load of a case in the place of that of the drive.
fn loaded(document: &mut Document, case: &str) -> Result<(), Finding> {
    let path = |name: &str| format!("case.{case}.{name}");
    for name in LOADS {
        if let Some(entry) = document.entries.get(&path(name)).cloned() {
            once(document, &path(name), &entry)?;
            let target = target(document, name, &entry)?;
            once_for_pulley(document, [&path(name), &path(&target)])?;
            put(document, &target, entry);
        }
    }
    let list = path("pulley.");
    let of_pulleys = document.entries.range(list.clone()..);
    let of_pulleys = of_pulleys.take_while(|(path, _)| path.starts_with(&list));
    let of_pulleys: Vec<_> = of_pulleys
        .filter(|(_, entry)| entry.content != Content::Table)
        .map(|(path, entry)| (path[list.len()..].to_owned(), entry.clone()))
        .collect();
    for (rest, entry) in of_pulleys {
        let (pulley, _) = schema::split(&rest);
        if !document.pulleys.iter().any(|known| known == pulley) {
            let place = document.entries.get(&path(&format!("pulley.{pulley}")));
            let place = place.map_or(entry.key.clone(), |table| table.key.clone());
            let pulleys = &document.pulleys;
            return Err(overrides::unknown(
                schema::PULLEY,
                "pulley",
                pulleys,
                (pulley, place),
            ));
        }
        once(document, &format!("{list}{rest}"), &entry)?;
        put(document, &format!("pulley.{rest}"), entry);
    }
    Ok(())
}

/// Whether a case states what an entry states in one way only.
fn once(document: &Document, path: &str, entry: &Entry) -> Result<(), Finding> {
    let others = schema::alternatives(path);
    match others
        .iter()
        .find(|other| document.entries.contains_key(*other))
    {
        None => Ok(()),
        Some(other) => {
            let [(table, one), (_, other)] = [path, other].map(schema::split);
            let message = format!(
                "both `{one}` and `{other}` are given in {}",
                schema::header(table)
            );
            Err(Finding::new(entry.key.clone(), message).expected("one of them"))
        }
    }
}

/// Whether a load of a case, at the first path, is not given at the second path, by the name of its pulley, too.
fn once_for_pulley(document: &Document, [path, named]: [&str; 2]) -> Result<(), Finding> {
    let others = schema::alternatives(named);
    let both = others.iter().map(String::as_str).chain([named]);
    let entries = &document.entries;
    match { both }.find_map(|other| Some((other, entries.get(other)?))) {
        None => Ok(()),
        Some((other, entry)) => {
            let message = format!("`{path}` and `{other}` are loads of the same pulley");
            Err(Finding::new(entry.key.clone(), message).expected("one of them"))
        }
    }
}

/// The key of the drive that `torque`, `power` or `speed` of a case stands for.
fn target(document: &Document, name: &str, entry: &Entry) -> Result<String, Finding> {
    let pulleys = &document.pulleys;
    if pulleys.is_empty() {
        return Ok(match name {
            "speed" => "pulleys.driver.speed".to_owned(),
            _ => format!("load.{name}"),
        });
    }
    let has = |pulley: &&String, duty: &str| {
        let path = format!("pulley.{pulley}.{duty}");
        document.entries.contains_key(&path)
    };
    let is_meant = |pulley: &&String| match name {
        "speed" => has(pulley, "speed"),
        _ => has(pulley, "torque") || has(pulley, "power"),
    };
    let meant: Vec<_> = pulleys
        .iter()
        .filter(is_meant)
        .map(String::as_str)
        .collect();
    if let [pulley] = meant[..] {
        return Ok(format!("pulley.{pulley}.{name}"));
    }
    let what = if name == "speed" {
        "a speed"
    } else {
        "a torque or a power"
    };
    let (message, names) = match meant.len() {
        0 => (
            format!("no pulley has {what} for this one to take the place of"),
            pulleys.iter().map(String::as_str).collect(),
        ),
        count => (
            format!("{count} pulleys have {what}: which one is meant?"),
            meant,
        ),
    };
    Err(Finding::new(entry.key.clone(), message).expected(format!(
        "pulley.NAME.{name} with NAME {}",
        check::one_of(&names)
    )))
}

/// Puts an entry of a case at a path of the drive.
fn put(document: &mut Document, path: &str, entry: Entry) {
    for (end, _) in path.match_indices('.') {
        let table = Entry {
            content: Content::Table,
            ..entry.clone()
        };
        let entries = &mut document.entries;
        entries.entry(path[..end].to_owned()).or_insert(table);
    }
    document.replace(path, entry);
}

/// The losses that the file gives.
fn given_losses(values: &Values<'_>) -> Result<GivenLosses, Finding> {
    let [stiffness, damping] = ["losses.bending_stiffness", "losses.bending_damping"];
    let bending = match (values.number(stiffness), values.number(damping)) {
        (None, None) => None,
        _ => Some(BendingLoss {
            stiffness: values.required_number(stiffness)?,
            damping: values.required_number(damping)?,
        }),
    };
    Ok(GivenLosses {
        bending,
        bearing_torque: values.number("losses.bearing_torque"),
    })
}
