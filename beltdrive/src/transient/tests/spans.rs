//! Spans that move across: their frequencies, their energy, their sag, and parametric resonance.

use super::super::axle::{Axle, Load, Motion};
use super::super::dynamics::Dynamics;
use super::super::ledger::Ledger;
use super::super::schedule::Schedule;
use super::super::state::Parts;
use super::super::string::{displacements, pluck};
use super::super::system::System;
use super::super::transverse::{Across, End, Pluck, SpanAcross};
use super::super::vibration;
use super::modes::{DURATION, fitted};
use super::{Explicit, Rates, STRETCH, follow, held, order, stable_step, system};
use std::f64::consts::{PI, TAU};

/// Length of a span, m.
const SPAN: f64 = 0.25;

/// First frequency of a span at rest, Hz.
const FIRST: f64 = 130.154_173;

/// The same drive with spans that move across.
fn across(system: System, damping: f64, gravity: [f64; 2]) -> System {
    let end = |pulley| End {
        pulley,
        amplitude: 0.0,
        order: 1.0,
        ahead: 0.0,
    };
    let span = |span: usize| SpanAcross {
        gravity: gravity[span],
        ends: [end(span), end(1 - span)],
    };
    System {
        parts: Parts::across(&system.mesh),
        across: Some(Across {
            damping,
            spans: vec![span(0), span(1)],
        }),
        ..system
    }
}

/// The belt with a speed in m/s and the first span plucked by so many m.
fn plucked(system: &System, speed: f64, amplitude: f64) -> Vec<f64> {
    let mut state = system.parts.uniform(1.0 / STRETCH, speed);
    pluck(
        system,
        &[Some(Pluck { amplitude, mode: 1 }), None],
        &mut state,
    );
    state
}

/// How much of the first half wave there is in a span, m.
fn half_wave(system: &System, state: &[f64], span: usize) -> f64 {
    let displaced = displacements(system, state, span);
    let cells = (displaced.len() - 1) as f64;
    let parts = { displaced.iter().enumerate() }
        .map(|(face, w)| w * (PI * face as f64 / cells).sin() * 2.0 / cells);
    parts.sum()
}

/// Free, but for a torque per speed.
fn loaded(inertia: f64, per_speed: f64) -> Axle {
    let load = Load {
        per_speed,
        ..Load::new(Schedule::constant(0.0))
    };
    Axle {
        inertia,
        motion: Motion::Torques { motor: None, load },
    }
}

#[test]
fn plucked_spans_have_the_frequency_of_the_moving_string_to_second_order() {
    for (speed, known) in [(0.0, FIRST), (9.75, 127.232_638)] {
        let errors = [80, 160, 320].map(|cells| {
            let system = system(cells, [0.0, 2.0e8], [held(), held()]);
            let system = across(system, 0.0, [0.0; 2]);
            let mut state = plucked(&system, speed, 1e-6);
            let (mut samples, mut next) = (vec![], 0.0);
            follow(&system, &mut state, DURATION, |time, state| {
                if time >= next {
                    samples.push([time, half_wave(&system, state, 0)]);
                    next = time + 2e-4;
                }
            });
            fitted(&samples, TAU * known) / (TAU * known) - 1.0
        });
        println!("{speed} m/s: {errors:?}, order {:.2}", order(&errors));
        assert!(errors[2].abs() < 8e-5, "{errors:?}");
        assert!((order(&errors) - 2.0).abs() < 0.1, "{errors:?}");
    }
}

/// The belt with a speed in m/s, whose spans lie without a kink on the lines between the pulleys: a sin²(π x/ℓ) with a in m. It has the same
/// tension everywhere: waves along that a jump of the tension makes would excite the spans at once.
fn arched(system: &System, speed: f64, amplitudes: [f64; 2]) -> Vec<f64> {
    let mut state = plucked(system, speed, 0.0);
    let parts = system.parts.across.as_ref().expect("spans");
    let (mut displaced, mut rising) = (parts.displacement.start, parts.velocity.start);
    for (span, amplitude) in system.mesh.spans.iter().zip(amplitudes) {
        for face in 0..=span.len() {
            let angle = PI * face as f64 / span.len() as f64;
            state[displaced] += amplitude * angle.sin().powi(2);
            let slope = amplitude * PI / SPAN * (2.0 * angle).sin();
            state[rising] += speed * slope;
            (displaced, rising) = (displaced + 1, rising + 1);
        }
        let first = displaced - span.len() - 1;
        for (index, cell) in span.clone().enumerate() {
            let ends = [0, 1].map(|end| state[first + index + end]);
            let slope = (ends[1] - ends[0]) / system.mesh.lengths[cell];
            state[system.parts.density.start + 1 + cell] *= 1.0 + 0.5 * slope * slope;
        }
    }
    system.parts.close(&mut state);
    state
}

#[test]
fn the_mesh_keeps_the_energy_of_a_span_at_rest() {
    let system = system(80, [0.0, 2.0e8], [held(), held()]);
    let system = across(system, 0.0, [0.0; 2]);
    let straight = system.energy(&system.parts.uniform(1.0 / STRETCH, 0.0));
    // Waves along ride on the motion across, the shortest of which the steps damp, and the less the shorter they are.
    let lost = [1.0, 4.0].map(|shorter| {
        let mut state = arched(&system, 0.0, [4e-3, 0.0]);
        let before = system.energy(&state);
        let (mut rates, mut explicit) = (Rates::new(&system), Explicit::new(system.parts.len()));
        rates.begin(0.0);
        let step = stable_step(&rates, &state) / shorter;
        let (mut time, mut least) = (0.0, f64::INFINITY);
        while time < 0.01 {
            explicit.rates(&mut rates, time, &mut state);
            explicit.step(&mut rates, time, step, &mut state);
            time += step;
            least = least.min(half_wave(&system, &state, 0));
        }
        assert!(least < -2e-3, "it swings to the other side: {least:e}");
        (system.energy(&state) - before) / (before - straight)
    });
    println!("{lost:?}");
    assert!(lost[0].abs() < 1e-3 && lost[1].abs() < 1e-5, "{lost:?}");
}

#[test]
fn the_ledger_of_spans_that_move_across_closes_to_second_order() {
    let residuals = [80, 160, 320].map(|cells| {
        let driver = Axle {
            inertia: 0.01,
            motion: Motion::Speed(Schedule::constant(120.0)),
        };
        // Without friction, whose contact is accounted for to first order where it starts to slip.
        let system = system(cells, [0.0, 2.0e8], [loaded(0.005, 0.02), driver]);
        let mut system = across(system, 2.0, [500.0, -300.0]);
        system.axial_damping = 0.5;
        let spans = &mut system.across.as_mut().expect("spans").spans;
        for (end, amplitude) in spans[0].ends.iter_mut().zip([2e-4, 1e-4]) {
            end.amplitude = amplitude;
            end.order = 3.0;
        }
        let mut state = arched(&system, 9.75, [3e-3, -2e-3]);
        state[system.parts.speed.clone()].fill(120.0);
        let begun = system.energy(&state);
        follow(&system, &mut state, 0.02, |_, _| {});
        let ledger = Ledger::of(&system, &state, begun);
        let terms = [ledger.gravity, ledger.run_out, ledger.damped_across];
        println!("{ledger:?}");
        assert!(terms.iter().all(|term| term.abs() > 1e-4), "{terms:?}");
        ledger.residual()
    });
    println!("{residuals:?}, order {:.2}", order(&residuals));
    assert!(residuals[2].abs() < 1e-6 && order(&residuals) > 1.8);
}

#[test]
fn a_span_sags_under_its_weight() {
    for gravity in [9.81, 1000.0] {
        let system = system(80, [0.0, 2.0e8], [held(), held()]);
        let mut system = across(system, 170.0, [gravity, 0.0]);
        system.axial_damping = 2.0;
        let mut state = plucked(&system, 0.0, 0.0);
        follow(&system, &mut state, 0.06, |_, _| {});
        let before = system.tension(STRETCH);
        let weight = system.mass / STRETCH * gravity;
        // The belt of the loop is stretched by the length that the sag takes.
        let taken = |tension: f64| weight.powi(2) * SPAN.powi(3) / (24.0 * tension.powi(2));
        let stretched = |tension: f64| STRETCH * (1.0 + taken(tension) / system.mesh.length());
        let tension = (0..20).fold(before, |tension, _| system.tension(stretched(tension)));
        let sag = displacements(&system, &state, 0)[10];
        let known = weight * SPAN * SPAN / (8.0 * tension);
        let risen = system.tension(state[system.parts.density.start + 1].recip()) - before;
        println!(
            "{sag:e} {known:e} {:e}; {risen} {}",
            sag / known - 1.0,
            tension - before
        );
        assert!((sag / known - 1.0).abs() < 2e-3, "{sag:e} {known:e}");
        assert!((risen / (tension - before) - 1.0).abs() < 2e-2, "{risen}");
    }
}

/// A drive whose driven pulley with an inertia in kg·m² vibrates against the belt without slip, with 20 cells on each
/// span.
fn torsional(inertia: f64) -> System {
    system(80, [12.0, 2.0e8], [loaded(inertia, 0.0), held()])
}

/// The angular frequency of that vibration, rad/s.
fn torsion(inertia: f64) -> f64 {
    let systems = [40, 80].map(|cells| System {
        ..system(cells, [12.0, 2.0e8], [loaded(inertia, 0.0), held()])
    });
    let states = systems
        .each_ref()
        .map(|system| (system, system.parts.uniform(1.0 / STRETCH, 0.0), None));
    let modes = vibration::modes(states, 1).expect("eigenvalues");
    modes[0].angular_frequency
}

/// The inertia with which it has a frequency, kg·m².
fn inertia_of(frequency: f64) -> f64 {
    let [mut low, mut high] = [5e-4, 5e-3];
    while high - low > 1e-7 * low {
        let middle = 0.5 * (low + high);
        match torsion(middle) > frequency {
            true => low = middle,
            false => high = middle,
        }
    }
    0.5 * (low + high)
}

/// Share of the tension of a span by which it fluctuates in such a vibration of a frequency in rad/s, and the rate at which the first half
/// wave of the span grows, 1/s.
fn fluctuating(frequency: f64) -> [f64; 2] {
    let system = across(torsional(inertia_of(frequency)), 0.0, [0.0; 2]);
    let mut state = plucked(&system, 0.0, 1e-7);
    state[system.parts.speed.start] = 3.0;
    let middle = system.mesh.spans[0].start + system.mesh.spans[0].len() / 2;
    let at_rest = system.tension(STRETCH);
    let (mut peak, mut peaks) = (0.0_f64, vec![]);
    let (mut parts, mut last) = ([0.0; 2], 0.0);
    let (window, end) = (0.02, 0.3);
    // After so many windows what decays does not show.
    const FROM: usize = 9;
    follow(&system, &mut state, end, |time, state| {
        let tension = system.tension(state[system.parts.density.start + 1 + middle].recip());
        // Over the time in which the growth is measured: the belt takes bristles out of the contact, which damps.
        if time > FROM as f64 * window {
            let weight = 2.0 * (time - last) / (end - FROM as f64 * window);
            let (sine, cosine) = (frequency * time).sin_cos();
            parts[0] += weight * (tension - at_rest) * sine;
            parts[1] += weight * (tension - at_rest) * cosine;
        }
        last = time;
        peak = peak.max(half_wave(&system, state, 0).abs());
        if time >= window * (peaks.len() + 1) as f64 {
            peaks.push(peak);
            peak = 0.0;
        }
    });
    println!("{parts:?} N, {peaks:?}");
    let to = peaks.len() - 1;
    let growth = (peaks[to] / peaks[FROM]).ln() / (window * (to - FROM) as f64);
    [parts[0].hypot(parts[1]) / at_rest, growth]
}

#[test]
fn a_tension_that_fluctuates_at_twice_a_frequency_makes_the_span_grow() {
    // The frequency of the span on the mesh.
    let half = PI / 40.0;
    let first = TAU * FIRST * half.sin() / half;
    // Off by so many rad/s.
    for off in [0.0, 20.0, 120.0] {
        let [share, growth] = fluctuating(2.0 * first + off);
        let square = (0.25 * share * first).powi(2) - 0.25 * off * off;
        println!("off {off}: {share} {growth} {square}");
        match square > 0.0 {
            // The rate of Mathieu's equation w̎ + ω² (1 + ε cos 2 ω t) w = 0, with 1 % less tension towards the ends of
            // the span, which the mass of the belt makes.
            true => assert!((growth / square.sqrt() - 0.99).abs() < 0.02, "{growth}"),
            false => assert!(growth.abs() < 1.0, "{growth}"),
        }
    }
}
