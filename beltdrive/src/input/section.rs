//! What a drive file takes from the belt section that it names.

use super::{
    check,
    diagnostic::Finding,
    document::{Content, Document, Entry},
    schema,
    source::Source,
    values::Values,
};
use crate::quantity::Measure;
use crate::sections::{self, Family, Figure, Section};
use std::collections::BTreeMap;

/// The entry that names a section.
const SECTION: &str = "belt.section";
/// The width of a flat belt whose section has numbers per width.
const WIDTH: &str = "belt.width";
/// The number of ribs or belts.
const RIBS: &str = "belt.ribs";

/// What a drive file leaves out and takes from a section.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct FilledIn {
    /// The section.
    pub section: &'static Section,
    /// Each entry that is filled in, in the order of the schema.
    pub entries: Vec<FilledEntry>,
    /// Pulleys that are smaller than the section allows: name, and diameter in m.
    pub too_small: Vec<(String, f64)>,
    /// Entries that the section would fill in and that have other contents since, by path.
    pub(super) replaced: BTreeMap<String, Entry>,
}

/// An entry of a drive file that is filled in.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct FilledEntry {
    /// Its dotted path.
    pub path: String,
    /// What it holds.
    pub value: FilledValue,
}

/// What is filled in.
#[derive(Clone, Debug, PartialEq)]
pub enum FilledValue {
    /// A word that follows from the family of the section.
    Word(&'static str),
    /// A number, for all belts or ribs or the whole width, SI, with its source.
    Number(Measure, Figure),
}

/// Whether what a section fills in depends on the number at a path, which is not a whole one.
pub(super) fn is_followed(path: &str) -> bool {
    let (_, name) = schema::split(path);
    path == WIDTH || ["radius", "diameter", "half_angle"].contains(&name)
}

/// Fills in what a document leaves out and its section has. What is at fault by itself is left to be found fault
/// with where all entries are checked.
pub(super) fn fill(document: &mut Document, source: &Source) -> Option<FilledIn> {
    let name = text(document, SECTION)?;
    let section = sections::SECTIONS
        .iter()
        .find(|section| section.name == name)?;
    let mut filling = Filling {
        document,
        source,
        entries: Vec::new(),
    };
    filling.belt(section);
    Some(FilledIn {
        section,
        too_small: filling.too_small(section),
        entries: filling.entries,
        replaced: BTreeMap::new(),
    })
}

/// Whether the entries beside that of the section suit it.
pub(super) fn check(values: &Values<'_>) -> Result<(), Finding> {
    let section = values
        .text(SECTION)
        .and_then(|name| sections::find(name).ok());
    let is_flat = section.is_some_and(|section| section.family == Family::Flat);
    if values.has(WIDTH) && !is_flat {
        let message = format!("`{WIDTH}` is for flat belts with numbers per width from a section");
        return Err(Finding::new(values.key_place(WIDTH), message)
            .expected("`belt.section` of a flat belt, or no width"));
    }
    let Some(section) = section else {
        return Ok(());
    };
    let is_v = values.text("belt.type") == Some("v");
    if is_v && section.family == Family::Flat {
        let message = format!(
            "section {} is that of a flat belt, not of a V-belt",
            section.name
        );
        return Err(Finding::new(values.place(SECTION), message).expected("type = \"flat\""));
    }
    let needed = match section.family {
        Family::Flat => WIDTH,
        Family::PolyV => RIBS,
        _ => return Ok(()),
    };
    let lacks = |path: &&str| !values.has(path);
    let lacking = ["belt.mass_per_length", "belt.axial_stiffness"]
        .into_iter()
        .find(lacks);
    match lacking {
        Some(lacking) if !values.has(needed) => {
            let what = match section.family {
                Family::Flat => "per width",
                _ => "those of one rib",
            };
            let message = format!(
                "the numbers of section {} are {what}: `{lacking}` follows from `{needed}`, which is missing",
                section.name
            );
            let rule = schema::rule(needed).expect("an entry of the schema");
            Err(Finding::new(values.place(SECTION), message).expected(rule.line()))
        }
        _ => Ok(()),
    }
}

/// A document that is being filled in.
struct Filling<'d> {
    document: &'d mut Document,
    source: &'d Source,
    entries: Vec<FilledEntry>,
}

impl Filling<'_> {
    fn belt(&mut self, section: &Section) {
        let of_family = match section.family.is_v() {
            true => "v",
            false => "flat",
        };
        self.word("belt.type", of_family);
        let is_v = text(self.document, "belt.type").as_deref() == Some("v");
        let count = self.number(RIBS);
        let count = match section.family {
            Family::Flat => self.number(WIDTH),
            Family::PolyV => count,
            _ => count.or((!self.has(RIBS)).then_some(1.0)),
        };
        if let Some(count) = count {
            let of_all = |figure: Option<Figure>| figure.map(|figure| figure.times(count));
            self.fill("belt.mass_per_length", of_all(section.mass));
            self.fill("belt.axial_stiffness", of_all(section.axial_stiffness));
            if is_v {
                // Before the radial stiffness, which depends on it.
                let half_angle = self.grooves(section);
                let stiffness = half_angle.and_then(|angle| section.radial_stiffness(angle));
                self.fill("belt.radial_stiffness", of_all(stiffness));
            }
        }
        if is_v {
            self.fill("belt.height", section.height);
        }
    }

    /// Fills in the half angle of the grooves, unless it is given: that of the driver's for the belt, and that of
    /// each pulley with another one. Tells the half angle of the belt.
    fn grooves(&mut self, section: &Section) -> Option<f64> {
        const OF_BELT: &str = "groove.half_angle";
        if self.has(OF_BELT) {
            return self.number(OF_BELT);
        }
        let tables = self.grooved_pulleys();
        let ungiven = tables.iter().map(|table| format!("{table}.half_angle"));
        let ungiven: Vec<_> = tables
            .iter()
            .zip(ungiven)
            .filter(|(_, path)| !self.has(path))
            .collect();
        let found = ungiven.into_iter().filter_map(|(table, path)| {
            let groove = section.groove(self.diameter(table)?)?;
            Some((path, groove.half_angle()))
        });
        let found: Vec<_> = found.collect();
        let (_, of_belt) = *found.first().as_ref()?;
        self.fill(OF_BELT, Some(*of_belt));
        for (path, figure) in &found {
            if figure != of_belt {
                self.fill(path, Some(*figure));
            }
        }
        Some(of_belt.value)
    }

    /// The pulleys inside the loop that are smaller than a section allows. Diameters may be off by rounding.
    fn too_small(&self, section: &Section) -> Vec<(String, f64)> {
        const ROUNDING: f64 = 1e-9;
        let Some(smallest) = section.smallest_diameter else {
            return Vec::new();
        };
        let tables = self.grooved_pulleys().into_iter();
        let small = tables.filter_map(|table| {
            let diameter = self.diameter(&table)?;
            let (_, name) = schema::split(&table);
            (diameter < smallest.value * (1.0 - ROUNDING)).then(|| (name.to_owned(), diameter))
        });
        small.collect()
    }

    /// The tables of the pulleys inside the loop, the driver first.
    fn grooved_pulleys(&self) -> Vec<String> {
        if !self.has(schema::PULLEY) {
            return ["driver", "driven"]
                .map(|name| format!("pulleys.{name}"))
                .to_vec();
        }
        let pulleys = self.document.pulleys.iter();
        let mut tables: Vec<_> = pulleys
            .map(|name| schema::join(schema::PULLEY, name))
            .collect();
        let is_inside = |table: &String| {
            let side = text(self.document, &format!("{table}.side"));
            side.is_none_or(|side| side == "inside")
        };
        tables.retain(is_inside);
        tables.sort_by_key(|table| !self.has(&format!("{table}.speed")));
        tables
    }

    /// The pitch diameter of a pulley, m, if it is given.
    fn diameter(&self, table: &str) -> Option<f64> {
        let radius = self.number(&format!("{table}.radius"));
        let diameter = || self.number(&format!("{table}.diameter"));
        radius.map(|radius| 2.0 * radius).or_else(diameter)
    }

    /// A number that is given and right, SI.
    fn number(&self, path: &str) -> Option<f64> {
        let entry = self.document.entries.get(path)?;
        check::quantity(path, entry, self.source).ok()
    }

    /// Fills in a word, unless the entry is given.
    fn word(&mut self, path: &str, word: &'static str) {
        if !self.has(path) {
            self.insert(path, Content::Text(word.to_owned()));
            self.entries.push(FilledEntry {
                path: path.to_owned(),
                value: FilledValue::Word(word),
            });
        }
    }

    /// Fills in a number, if there is one, unless the entry is given.
    fn fill(&mut self, path: &str, figure: Option<Figure>) {
        let Some(figure) = figure.filter(|_| !self.has(path)) else {
            return;
        };
        let rule = schema::quantity_rule(path).expect("a quantity of the schema");
        let measure = rule.dimension.measure().expect("a measure of drive files");
        self.insert(path, Content::Number(figure.value));
        self.entries.push(FilledEntry {
            path: path.to_owned(),
            value: FilledValue::Number(measure, figure),
        });
    }

    /// Inserts an entry, and its table if there is none, at the place of that of the section.
    fn insert(&mut self, path: &str, content: Content) {
        let at = self.document.entries[SECTION].clone();
        let (table, _) = schema::split(path);
        let of_table = Entry {
            content: Content::Table,
            ..at.clone()
        };
        let entries = &mut self.document.entries;
        entries.entry(table.to_owned()).or_insert(of_table);
        entries.insert(path.to_owned(), Entry { content, ..at });
    }

    fn has(&self, path: &str) -> bool {
        self.document.entries.contains_key(path)
    }
}

/// The text of an entry, if it is one.
fn text(document: &Document, path: &str) -> Option<String> {
    match &document.entries.get(path)?.content {
        Content::Text(text) => Some(text.clone()),
        _ => None,
    }
}
