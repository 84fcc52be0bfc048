//! The closed forms against numbers of Kim (2009) and of independent computations.
use super::closed_form::*;
use super::contact::*;
use super::traction::Traction;
use super::*;
use crate::*;
use std::f64::consts::PI;

const M: f64 = 0.1036;
const EA: f64 = 80068.0;
const R: f64 = 0.08125;
const MU: f64 = 1.2;

fn arc(conv: NormalForce, driven: bool, tl: f64, th: f64, v: f64) -> Arc {
    let belt = Traction::new(conv, M, EA, v);
    let (lo, hi) = (belt.of_tension(tl), belt.of_tension(th));
    Arc {
        belt,
        sense: if driven { 1.0 } else { -1.0 },
        slip_rate: belt.slip_rate(MU, R),
        length: PI * R,
        entry: if driven { lo } else { hi },
        change: hi - lo,
    }
}

#[test]
fn numbers() {
    let v = 119.1 * R;
    for (k, tl, th) in [
        (2.76821e7, 156.2, 712.2),
        (2.0e8, 155.1, 716.7),
        (8.1e9, 158.3, 707.1),
    ] {
        for conv in NormalForce::ALL {
            let a = epp::solve(arc(conv, true, tl, th, v), k).unwrap();
            let b = epp::solve(arc(conv, false, tl, th, v), k).unwrap();
            println!(
                "{conv:?} {k:e} {} {} To {} e {:e} zones {} ev {} {} kmin {:?} {:?}",
                a.zones[0].end / R,
                b.zones[0].end / R,
                a.arc.belt.tension(a.reference()),
                a.strain,
                a.zones.len(),
                a.evaluations,
                b.evaluations,
                epp::smallest_stiffness(a.arc),
                epp::smallest_stiffness(b.arc)
            );
            for c in [&a, &b] {
                let z = c.zones.last().unwrap();
                println!("   end {:e}", c.end(z).traction / c.arc.exit() - 1.0);
            }
        }
    }
    let drive = |law, tl, th, conv| Drive {
        title: None,
        belt: Belt {
            mass_per_length: M,
            axial_stiffness: EA,
            kind: BeltKind::Flat { normal_force: conv },
        },
        friction_coefficient: MU,
        law,
        driver_radius: R,
        driven_radius: R,
        driver_speed: 120.0,
        centre_distance: 0.3,
        load: Load {
            slack: SpanTension::Belt(tl),
            tight: SpanTension::Belt(th),
        },
    };
    for (law) in [
        FrictionLaw::Coulomb,
        FrictionLaw::CreepRate { velocity: 0.01 },
        FrictionLaw::CreepRate { velocity: 0.03 },
        FrictionLaw::CreepRate { velocity: 1e-9 },
        FrictionLaw::Epp { stiffness: 2e8 },
    ] {
        let d = drive(law, 155.1, 716.7, NormalForce::Inertia);
        let s = ClosedForm::new(&d).unwrap();
        println!(
            "{law:?} {} {} w1 {} c {} ev {}",
            s.contact[0].zones[0].end / R,
            s.contact[1].zones[0].end / R,
            s.rim_speed(&d, 0) / R,
            s.speed,
            s.evaluations
        );
    }
    for k in [1e5, 1e6, 1e7, 8.1e7, 1e9, 1e14] {
        for th in [
            200.0,
            200.0 * (1.0 + 1e-9),
            400.0,
            4000.0,
            8000.0,
            8200.0,
            8300.0,
        ] {
            for conv in NormalForce::ALL {
                let d = drive(FrictionLaw::Epp { stiffness: k }, 200.0, th, conv);
                match ClosedForm::new(&d) {
                    Ok(s) => println!(
                        "{k:e} {th} {conv:?} w1 {} ev {} zones {:?} {:?} end {:e}",
                        s.rim_speed(&d, 0) / R,
                        s.evaluations,
                        s.contact[0]
                            .zones
                            .iter()
                            .map(|z| z.end / R)
                            .collect::<Vec<_>>(),
                        s.contact[1]
                            .zones
                            .iter()
                            .map(|z| z.end / R)
                            .collect::<Vec<_>>(),
                        {
                            let c = &s.contact[0];
                            c.end(c.zones.last().unwrap()).traction / c.arc.exit() - 1.0
                        }
                    ),
                    Err(e) => println!("{k:e} {th} {conv:?} {e:?}"),
                }
            }
        }
    }
}
