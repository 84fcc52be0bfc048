use super::super::axle::{Axle, Load, Motion};
use super::super::explicit::{Dynamics, Explicit};
use super::super::schedule::Schedule;
use super::super::simulation::{Cells, Simulation, Start, Until};
use super::initial;
use super::rates::Rates;
use crate::{BeltKind, examples, input};

fn stated(cells: usize, load: f64, start: f64, driver: f64) -> Simulation {
    let example = examples::find("kim2009-bristle").unwrap();
    let drive = input::parse(example.name, example.text, &[]).unwrap();
    let speed = if start > 0.0 {
        Schedule::ramp([0.0, start], [0.0, driver])
    } else {
        Schedule::constant(driver)
    };
    let driver = Axle { inertia: 0.1, motion: Motion::Speed(speed) };
    let driven = Axle {
        inertia: 0.05,
        motion: Motion::Torques { motor: None, load: Load::new(Schedule::constant(load)) },
    };
    let axles = drive.pulleys.iter().map(|p| if p.name == "driver" { driver.clone() } else { driven.clone() }).collect();
    Simulation {
        drive, axles, axial_damping: 1.0, start: Start::Running, cells: Cells::Total(cells),
        until: Until::Time(1.0), interval: 0.01, instants: vec![], step: None,
    }
}

#[test]
fn explore() {
    let cells: usize = std::env::var("CELLS").map_or(120, |c| c.parse().unwrap());
    let end: f64 = std::env::var("END").map_or(0.5, |c| c.parse().unwrap());
    let rest = std::env::var("REST").is_ok();
    let s0 = stated(cells, 0.0, 0.0, 0.0);
    let found = crate::belt_loop::solve(&s0.drive).unwrap();
    for p in &found.pulleys { println!("{} w {} M {} wrap {}", p.name, p.angular_speed, p.torque, p.wrap.to_degrees()); }
    for s in &found.spans { println!("T {} F {} l {}", s.tension, s.tractive_tension, s.length); }
    println!("L {} rest T {}", found.unstretched_length, found.rest_tension);
    let load: f64 = std::env::var("LOAD").map_or(1.0, |c| c.parse().unwrap()) * found.pulleys.iter().map(|p| p.torque).fold(0.0, f64::max);
    let driver = found.pulleys.iter().find(|p| p.torque < 0.0).unwrap().angular_speed;
    let s = stated(cells, load, if rest {0.2} else {0.0}, driver);
    let BeltKind::V(belt) = s.drive.belt.kind else { panic!() };
    let system = initial::system(&s, &s.drive, &belt, &found).unwrap();
    let mut rates = Rates::new(&system);
    let mut state = if rest { initial::at_rest(&mut rates, &found).unwrap() } else { initial::running(&mut rates, &found).unwrap() };
    let mut ex = Explicit::with_room(system.parts.len());
    let begun = std::time::Instant::now();
    let mut t = 0.0;
    let mut next = 0.0;
    rates.begin(0.0);
    ex.rates(&mut rates, 0.0, &mut state);
    let e0 = system.energy(&state, &rates.lengths);
    let m0 = system.unstretched_length(&state);
    let mut steps = 0;
    loop {
        rates.begin(t);
        ex.rates(&mut rates, t, &mut state);
        if t >= next {
            let p = &system.parts;
            let mid = |s: &std::ops::Range<usize>| system.tension(rates.stretches()[(s.start+s.end)/2]);
            let e = system.energy(&state, &rates.lengths);
            let w: f64 = state[p.work.clone()].iter().sum();
            let res = w - (e - e0) - state[p.damped] - state[p.friction] - state[p.compression];
            let depth = rates.depths.iter().map(|d| d.iter().copied().fold(0.0, f64::max)).collect::<Vec<_>>();
            println!("{t:.4} T {:?} w {:?} M {:?} depth {depth:?} W {w:.3} dE {:.3} fr {:.3} cp {:.4} res {res:.2e} mass {:.1e}",
                system.mesh.spans.iter().map(mid).collect::<Vec<_>>(), &state[p.speed.clone()], rates.torque, e-e0,
                state[p.friction], state[p.compression], system.unstretched_length(&state)/m0-1.0);
            next += end / 10.0;
        }
        if t >= end || !state.iter().all(|x| x.is_finite()) { break; }
        let dt = 0.9*2.7/rates.fastest(&state);
        if steps == 0 { println!("dt {dt:e}"); }
        let dt = dt.min(end - t).min((next - t).max(1e-12));
        ex.step(&mut rates, t, dt, &mut state);
        t += dt; steps += 1;
    }
    println!("{steps} steps {:?}", begun.elapsed());
}
