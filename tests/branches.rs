//! scratch
use bvp::{Constant, Ends, Family, Options as B, Problem, Real, Segment, Scheme};
use continuation::{Branch, Direction, Kind, Leg, LimitPointCurve, Options};
use reference_problems::Curve;

struct Bratu;
impl Problem for Bratu {
    fn segments(&self) -> &[Segment] { &[Segment { states: 2, from: 0.0, to: 1.0 }] }
    fn parameters(&self) -> usize { 1 }
    fn condition_count(&self) -> usize { 2 }
    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) { dy[0] = y[1]; dy[1] = -p[0] * y[0].exp(); }
    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) { r[0] = at.start(0)[0]; r[1] = at.end(0)[0]; }
}
struct Integral;
impl Problem for Integral {
    fn segments(&self) -> &[Segment] { &[Segment { states: 3, from: 0.0, to: 1.0 }] }
    fn parameters(&self) -> usize { 2 }
    fn condition_count(&self) -> usize { 3+0 }
    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) { dy[0] = y[1]; dy[1] = -p[0] * y[0].exp(); dy[2]=y[0]; }
    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) { r[0] = at.start(0)[0]-at.end(0)[0]-p[1]; r[1] = at.start(0)[2]; r[2]=at.end(0)[2]; }
}
struct Elastica;
impl Problem for Elastica {
    fn segments(&self) -> &[Segment] { &[Segment { states: 2, from: 0.0, to: 1.0 }] }
    fn parameters(&self) -> usize { 1 }
    fn condition_count(&self) -> usize { 2 }
    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) { dy[0] = y[1]; dy[1] = -p[0] * y[0].sin(); }
    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) { r[0] = at.start(0)[1]; r[1] = at.end(0)[1]; }
}
#[test]
fn bratu() {
    for (tol, scheme) in [(1e-6, Scheme::Gauss{stages:4}), (1e-12, Scheme::Gauss{stages:6})] {
    let o = B { tolerance: tol, scheme, ..B::default() };
    let (family, z) = Family::new(&Bratu, 0, &[], &Constant { states: vec![vec![0.0; 2]], parameters: vec![0.0] }, &o).unwrap();
    let mut c = Curve { family, second: 0 };
    let t = std::time::Instant::now();
    let mut b = Branch::new(&mut c, &z, Direction::Increasing, &Options { targets: vec![0.5, 1.0, 3.5], ..Options::within(0.0, 4.0) }).unwrap();
    let mut n = 0;
    while let Some(p) = b.next() {
        n += 1;
        let s = b.system().family.solution(&p.z);
        println!("{:?} λ={:.16} u'(0)={:.14} err {:?} s={:.4} mesh {} defect {:.1e}", p.kind, p.lambda(), s.start(0)[1], p.error, p.arclength, s.mesh(0).len()-1, s.defect());
    }
    println!("{n} {:?} {:?}", b.stop(), t.elapsed());
    }
}
#[test]
fn elastica() {
    let o = B { tolerance: 1e-9, ..B::default() };
    let (family, z) = Family::new(&Elastica, 0, &[], &Constant { states: vec![vec![0.0; 2]], parameters: vec![1.0] }, &o).unwrap();
    let mut c = Curve { family, second: 0 };
    let o = Options { ..Options::within(1.0, 400.0) };
    let mut b = Branch::new(&mut c, &z, Direction::Increasing, &o).unwrap();
    let mut bps = vec![];
    while let Some(p) = b.next() {
        println!("{:?} λ={:.16} err {:?} s={:.4} {}", p.kind, p.lambda(), p.error, p.arclength, b.system().family.solution(&p.z).mesh(0).len()-1);
        if p.kind == Kind::BranchPoint { bps.push((b.system().clone(), p)); }
    }
    println!("{:?}", b.into_stop());
    for (mut c, p) in bps {
        for leg in [Leg::Forward, Leg::Backward] {
        let mut b = Branch::switch(&mut c, &p, leg, &o).unwrap().event(|s: &Curve<'_>, z: &[f64]| s.family.solution(z).start(0)[0].abs() - 2.0);
        while let Some(p) = b.next() {
            let s = b.system().family.solution(&p.z);
            if p.kind != Kind::Regular { println!("   {:?} λ={:.16} u0 {:.12} err {:?} s={:.4} {}", p.kind, p.lambda(), s.start(0)[0], p.error, p.arclength, b.system().family.solution(&p.z).mesh(0).len()-1);}
        }
        println!("{:?}", b.stop());
        }
    }
}
#[test]
fn integral() {
    let o = B { tolerance: 1e-10, ..B::default() };
    let (family, z) = Family::new(&Integral, 0, &[1], &Constant { states: vec![vec![0.0; 3]], parameters: vec![0.0,0.0] }, &o).unwrap();
    let mut c = Curve { family, second: 1 };
    let o = Options { ..Options::within(0.0, 15.0) };
    let mut b = Branch::new(&mut c, &z, Direction::Increasing, &o).unwrap();
    let mut lp = None;
    while let Some(p) = b.next() {
        println!("{:?} λ={:.16} err {:?} s={:.4}", p.kind, p.lambda(), p.error, p.arclength);
        if p.kind == Kind::LimitPoint { lp = Some(p); break; }
    }
    println!("{:?}", b.into_stop());
    let lp = lp.unwrap();
    let mut l = LimitPointCurve::new(c.clone(), &lp.z).unwrap();
    let s = l.start(&lp.z);
    let t = std::time::Instant::now();
    let mut b = Branch::new(&mut l, &s, Direction::Increasing, &Options { targets: vec![1.0,2.0,4.0,8.0], ..Options::within(-1.0, 9.0) }).unwrap().event(|_: &LimitPointCurve<Curve<'_>>, z: &[f64]| z[z.len()-2]-3.0);
    while let Some(p) = b.next() {
        println!("{:?} μ={:.14} λ={:.14} err {:?} s={:.4}", p.kind, p.lambda(), p.x()[p.x().len()-1], p.error, p.arclength);
    }
    println!("{:?} {:?}", b.stop(), t.elapsed());
}
