//! Belt sections with their numbers: widths, heights, grooves, mass, stiffness, each with its source.
//!
//! A [`Figure`] says where its number comes from and whether it is an estimate. `belt.section = "SPB"` in a drive
//! file takes what the file leaves out from here ([`crate::input::DriveFile::filled_in`]).
//!
//! ```
//! use beltdrive::sections::{Kind, find};
//!
//! let section = find("SPB")?;
//! let mass = section.mass.expect("every section has one");
//! assert_eq!((mass.value, mass.kind), (0.195, Kind::Printed));
//! // Grooves of small pulleys are narrower, because the belt bulges where it is bent.
//! let angle = |diameter| section.groove(diameter).map(|groove| groove.angle.to_degrees().round());
//! assert_eq!([angle(0.14), angle(0.28)], [Some(34.0), Some(38.0)]);
//! # Ok::<(), beltdrive::sections::UnknownSection>(())
//! ```

mod classical;
mod estimates;
mod figure;
mod flat;
mod groove;
mod narrow;
mod poly_v;
mod source;

pub use figure::{Figure, Kind};
pub use groove::{Groove, GrooveRule, GrooveStep};
pub use source::Source;

use crate::input::spelling;

/// A belt section.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Section {
    /// The name it is asked for by.
    pub name: &'static str,
    /// Other designations of the same section; empty if there are none.
    pub also: &'static str,
    /// The family it belongs to.
    pub family: Family,
    /// Width of the belt at its back, m.
    pub top_width: Option<Figure>,
    /// Height of the belt, m.
    pub height: Option<Figure>,
    /// Width of a V-belt at its pitch line, m, or in the effective system that of the groove at its top; of a poly-V
    /// belt the distance between its ribs.
    pub datum_width: Option<Figure>,
    /// Depth of the pitch line of a V-belt below its back, m.
    pub pitch_line_depth: Option<Figure>,
    /// Height of the pitch line of a poly-V belt above the outside of a pulley, m.
    pub pitch_line_height: Option<Figure>,
    /// Angle between the faces of the belt before it is bent, rad.
    pub wedge_angle: Option<Figure>,
    /// Groove angles of its pulleys; the first rule is the one that drive files use.
    pub grooves: &'static [GrooveRule],
    /// Smallest diameter of a pulley, m: to the pitch line of V-belts, to the outside of the pulley otherwise.
    pub smallest_diameter: Option<Figure>,
    /// Mass per length of one belt or rib, kg/m; of a flat belt, per length and width, kg/m².
    pub mass: Option<Figure>,
    /// Axial stiffness EA of one belt or rib, N; of a flat belt, per width, N/m.
    pub axial_stiffness: Option<Figure>,
    /// Modulus E of a V-belt against compression between the faces of a groove, Pa.
    pub transverse_modulus: Option<Figure>,
}

/// A family of sections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Classical V-belts, ISO 4184, DIN 2215.
    Classical,
    /// Narrow V-belts in the datum system, ISO 4184, DIN 7753-1.
    NarrowIso,
    /// Narrow V-belts in the effective system, RMA/MPTA IP-22, ISO 5290.
    NarrowRma,
    /// Poly-V belts, ISO 9982, DIN 7867.
    PolyV,
    /// Flat belts.
    Flat,
}

impl Family {
    /// The name of the family in outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Classical => "classical",
            Self::NarrowIso => "narrow DIN/ISO",
            Self::NarrowRma => "narrow RMA/MPTA",
            Self::PolyV => "poly-V",
            Self::Flat => "flat",
        }
    }

    /// Whether its belts run in one groove each.
    pub fn is_v(self) -> bool {
        matches!(self, Self::Classical | Self::NarrowIso | Self::NarrowRma)
    }
}

impl Section {
    /// The groove of a pulley of a diameter in m, by the first of the rules.
    pub fn groove(&self, diameter: f64) -> Option<Groove> {
        self.grooves.first().map(|rule| rule.groove(diameter))
    }

    /// Radial stiffness k of one belt in a groove with the half angle β in rad: line load per radial penetration,
    /// N/m²; an estimate, for V-belts only.
    ///
    /// A belt that sinks by x is squeezed by 2 x tan β over its width b. Its faces of height h then take the lateral
    /// line load h E 2 x tan β / b each, which the model of V-belts writes as k x/2: k = 4 E (h/b) tan β, with
    /// the datum width for b.
    pub fn radial_stiffness(&self, half_angle: f64) -> Option<Figure> {
        let (height, width) = (self.height?.value, self.datum_width?.value);
        let factor = 4.0 * height / width * half_angle.tan();
        Some(self.transverse_modulus?.times(factor))
    }
}

/// The number of sections.
pub(crate) const COUNT: usize = 6 + 4 + 3 + 5 + 8;

/// Every section, family by family, from small to large.
pub static SECTIONS: [Section; COUNT] = ALL;

const ALL: [Section; COUNT] = {
    let mut all = [classical::SECTIONS[0]; COUNT];
    let families: [&[Section]; 5] = [
        &classical::SECTIONS,
        &narrow::ISO,
        &narrow::RMA,
        &poly_v::SECTIONS,
        &flat::SECTIONS,
    ];
    let (mut family, mut place) = (0, 0);
    while family < families.len() {
        let mut index = 0;
        while index < families[family].len() {
            all[place] = families[family][index];
            (index, place) = (index + 1, place + 1);
        }
        family += 1;
    }
    assert!(place == COUNT);
    all
};

/// The names of all sections, in their order.
pub(crate) const NAMES: [&str; COUNT] = {
    let mut names = [""; COUNT];
    let mut place = 0;
    while place < COUNT {
        names[place] = ALL[place].name;
        place += 1;
    }
    names
};

/// A name that no section has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no section `{name}`\nexpected: one of {}{}", names(), spelling::hint(*.nearest))]
pub struct UnknownSection {
    name: String,
    nearest: Option<&'static str>,
}

/// The section called `name`, by its own or another designation.
///
/// # Errors
/// There is none of this name; the error shows the nearest.
pub fn find(name: &str) -> Result<&'static Section, UnknownSection> {
    let is_called = |section: &&Section| {
        section.name == name || section.also.split(", ").any(|other| other == name)
    };
    SECTIONS
        .iter()
        .find(is_called)
        .ok_or_else(|| UnknownSection {
            name: name.to_owned(),
            nearest: spelling::nearest(name, NAMES.map(|name| (name, name))),
        })
}

fn names() -> String {
    NAMES.map(|name| format!("`{name}`")).join(", ")
}

#[cfg(test)]
mod tests;
