//! Where the numbers of sections are from.

/// Where a number is from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Source {
    /// A catalogue of Optibelt.
    OptibeltCatalogue,
    /// Groove tables of Optibelt.
    OptibeltGrooves,
    /// A manual of Optibelt on ribbed belts.
    OptibeltRibbed,
    /// A catalogue of `ContiTech` on ribbed belts.
    ContiTech,
    /// GOST 20889-88.
    Gost20889,
    /// Data sheets of Megadyne.
    Megadyne,
    /// Catalogue pages of beltservice.com.
    BeltService,
    /// A design manual with the sections A to D.
    DesignManual,
    /// A belt dealer's table.
    Dealer,
    /// Groove tables of Gates.
    GatesGrooves,
    /// Data of flat belts of Gates Mectrol.
    GatesMectrol,
    /// A glossary of RMA IP-22.
    RmaGlossary,
    /// ISO 8419.
    Iso8419,
    /// The belts of Kim's thesis.
    Kim2009,
    /// A program for accessory drives.
    AccessoryDrives,
    /// A note of Gates on efficiencies.
    GatesEfficiency,
    /// The relation of Ruess between hardness and modulus of rubber.
    Ruess,
}

impl Source {
    /// The full citation, with what to be careful about.
    pub fn citation(self) -> &'static str {
        match self {
            Self::OptibeltCatalogue => {
                "Optibelt, Industrial Power Transmission Catalog OCSC1213 (2013), conversion tables: \
                 approximate weights"
            }
            Self::OptibeltGrooves => {
                "Optibelt, technical manual of V-belt drives, grooves to DIN 2211 and DIN 2217, as \
                 transcribed elsewhere"
            }
            Self::OptibeltRibbed => {
                "Optibelt, technical manual of ribbed belt drives, table of profiles, as transcribed elsewhere"
            }
            Self::ContiTech => "ContiTech, Conti-V Multirib, table 1, as transcribed elsewhere",
            Self::Gost20889 => "GOST 20889-88, pulleys for V-belts, aligned with ISO 4183",
            Self::Megadyne => "Megadyne, Oleostatic Gold, data sheets of SPA, SPB and SPC",
            Self::BeltService => "Belt Service Corporation, catalogue pages of V-guides",
            Self::DesignManual => {
                "Design Manual for Power Transmission Belts, classical V-belts A to D"
            }
            Self::Dealer => {
                "a dealer's table of narrow V-belts; its masses are headed kg/m and taken as g/m"
            }
            Self::GatesGrooves => {
                "Gates, PowerBand groove tables, read from a damaged copy; diameters are effective ones"
            }
            Self::GatesMectrol => "Gates Mectrol, flat belt specifications, open ended belts",
            Self::RmaGlossary => "summary of RMA IP-22: top widths 3/8, 5/8 and 1 inch",
            Self::Iso8419 => {
                "ISO 8419, narrow V-belts 9N/J, 15N/J and 25N/J, scope: effective widths of grooves"
            }
            Self::Kim2009 => {
                "D. Kim, MS thesis, Georgia Institute of Technology (2009): a V-belt with EA/m = 1.11e6 N·m/kg \
                 and k = 900 kN/m², a flat belt with EA/m = 0.77e6 N·m/kg"
            }
            Self::AccessoryDrives => {
                "a public program for accessory drives: PK belts with 11 kN per rib from resonances and 18 to \
                 43 kN from creep, at 0.021 kg/m per rib"
            }
            Self::GatesEfficiency => {
                "Gates, technical note on belt drive efficiencies: 95 to 98 % of well-designed V-belt drives, \
                 which the model of V-belts has at 10 to 35 MPa"
            }
            Self::Ruess => {
                "Ruess: lg(E/MPa) = 0.0235 S − 0.6403 for the Shore A hardness S; 5.9 MPa at 60, 17 MPa at 80"
            }
        }
    }
}
