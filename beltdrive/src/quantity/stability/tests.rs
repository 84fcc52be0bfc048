//! Tests of the answer.

use super::{answer, sample};
use crate::quantity::UnitSystem;
use crate::report::{csv, json, table};
use std::f64::consts::TAU;

#[test]
fn the_table_has_modes_a_summary_and_their_meaning() {
    let text = table(&answer(&sample::stability()), UnitSystem::Engineering);
    insta::assert_snapshot!(text, @r#"
    Flat belt, "made up" <&>
    elastic/perfectly-plastic friction, μ = 0.6, k_f = 5e7 N/m², normal force n = (T − G V)/R
    Stability of the axial motion: small displacements f(s) exp(λ t) of the belt about the steady state
    (1) outlet f' = 0 (thesis)  slip friction follows T, f' = 0 at the outlet
    (2) natural outlet          slip friction follows T, D f' = m v λ f at the outlet
    (3) conservative            slip friction follows T − G V, D f' = m v λ f at the outlet

    tight tractive tension                         420.000  N

    critical speed √(EA/m)                         1291.00  m/s

                                                    driver                      driven
    belt speed                                     25.0500                     25.0125  m/s
    contact                                        171.887                     114.592  °
    slip from                                      114.592                     57.2958  °

                                                                    Re
                         Im λ     Im λ     Re λ     Im λ     Im λ    λ     Im λ     Im λ
    driver  Re λ (1)      (1)      (1)      (2)      (2)      (2)  (3)      (3)      (3)
                 1/s    rad/s       Hz      1/s    rad/s       Hz  1/s    rad/s       Hz
         1  −40.0000  10000.0  1591.55  3.25000  10000.0  1591.55    0  10000.0  1591.55
         2  −19.3750  20000.0  3183.10  2.31250  20000.0  3183.10    0  20000.0  3183.10
         3  −15.5556  30000.0  4774.65  2.13889  30000.0  4774.65    0  30000.0  4774.65
         4  −14.2188  40000.0  6366.20  2.07812  40000.0  6366.20    0  40000.0  6366.20

    driver                                    thesis        natural outlet          conservative
    largest Re λ                            −14.2188               3.25000                     0  1/s
      in mode                                      4                     1                   all
    limit of Re λ, high modes               −12.5000               2.00000                     0  1/s
    grows from                               480.000               150.500                 never  N
      first in mode                                2            high modes                     –
    counted up to |Im λ|                     45000.0               45000.0               45000.0  rad/s
    eigenvalues found there                        8                     8                     8
    methods differ at most by                2.0e−12               2.0e−12               2.0e−12

                                                                     Re
    driven               Im λ     Im λ               Im λ     Im λ    λ     Im λ     Im λ
    pulley  Re λ (1)      (1)      (1)  Re λ (2)      (2)      (2)  (3)      (3)      (3)
                 1/s    rad/s       Hz       1/s    rad/s       Hz  1/s    rad/s       Hz
         1  −128.000  10000.0  1591.55  −7.00000  10000.0  1591.55    0  10000.0  1591.55
         2  −51.1250  20000.0  3183.10  −4.00000  20000.0  3183.10    0  20000.0  3183.10
         3  −36.8889  30000.0  4774.65  −3.44444  30000.0  4774.65    0  30000.0  4774.65
         4  −31.9062  40000.0  6366.20  −3.25000  40000.0  6366.20    0  40000.0  6366.20

    driven pulley                             thesis        natural outlet          conservative
    largest Re λ                            −31.9062              −3.25000                     0  1/s
      in mode                                      4                     4                   all
    limit of Re λ, high modes               −25.5000              −3.00000                     0  1/s
    grows from                            none found            none found                 never  N
    counted up to |Im λ|                     45000.0               45000.0               45000.0  rad/s
    eigenvalues found there                        8                     8                     8
    methods differ at most by                2.0e−12               2.0e−12               2.0e−12

    With the thesis's outlet condition every motion found decays at this load, but the belt on the
        driver turns unstable at a tight tractive tension of 480 N (mode 2 first); with the inertia of
        the normal force and the natural outlet condition kept the motion is exactly conservative (Re λ
        = 0), so that this growth, like the decay on the driven pulley, comes from the terms left out
        and not from the drive.
    "#);
}

#[test]
fn a_belt_need_not_slip() {
    let mut stability = sample::stability();
    for on in [&mut stability.driver, &mut stability.driven] {
        on.transition = on.contact_length;
    }
    let text = table(&answer(&stability), UnitSystem::Si);
    assert!(
        text.contains("contact") && !text.contains("slip from"),
        "{text}"
    );
}

#[test]
fn json_is_complete() {
    let stability = sample::stability();
    let text = json(&answer(&stability));
    let report: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(report["load"]["tight_tractive_tension_N"], 420.0);
    let driver = &report["driver"];
    assert_eq!(driver["slips"], true);
    let thesis = &driver["forms"]["thesis"];
    assert_eq!(thesis["modes"].as_array().unwrap().len(), sample::MODES);
    let second = &thesis["modes"][1];
    assert_eq!(second["number"], 2);
    assert_eq!(second["angular_frequency_rad_per_s"], 20_000.0);
    assert_eq!(second["frequency_Hz"], 20_000.0 / TAU);
    assert_eq!(second["grows"], false);
    assert_eq!(thesis["largest_growth"]["mode"], 4);
    assert_eq!(thesis["grows"], false);
    assert!(driver["forms"]["conservative"]["largest_growth"]["mode"].is_null());
    assert_eq!(thesis["onset"]["tight_tractive_tension_N"], 480.0);
    assert_eq!(thesis["onset"]["mode"], 2);
    assert_eq!(thesis["box"]["growth_bound_per_s"], 90.0);
    assert_eq!(thesis["counted"], 8);
    assert!(report["driven"]["forms"]["thesis"]["onset"].is_null());
    assert!(driver["forms"]["conservative"]["onset"].is_null());
    let natural = &driver["forms"]["natural_outlet"];
    assert!(natural["onset"]["mode"].is_null() && natural["grows"] == true);
    assert!(report["meaning"].as_str().unwrap().contains("480 N"));
    let modes = &report["driven"]["forms"]["thesis"]["modes"];
    let shape = &modes[0]["shape"];
    for column in ["arc_length_m", "real", "imaginary"] {
        let values = shape[column].as_array().unwrap();
        assert_eq!(values.len(), stability.driven.forms[0].modes[0].shape.len());
    }
    assert_eq!(shape["arc_length_m"][0], 0.0);
    assert!(modes[3].get("shape").is_none());
}

#[test]
fn csv_has_a_row_for_each_pulley_form_and_mode() {
    let text = csv(&answer(&sample::stability()));
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(lines.len(), 1 + 2 * 3 * sample::MODES);
    let header = "pulley,form,mode,growth_per_s,angular_frequency_rad_per_s,frequency_Hz,\
        method_difference,grows,normal_force";
    assert_eq!(lines[0], header);
    assert!(
        lines[1].starts_with("driver,thesis,1,-40,10000,1591.54"),
        "{text}"
    );
    assert!(lines[1].ends_with(",false,inertia"));
    assert!(
        lines[lines.len() - 1].starts_with("driven,conservative,4,"),
        "{text}"
    );
}
