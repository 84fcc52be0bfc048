use continuation::*;
fn trace(name: &str, system: &mut DenseSystem, start: &[f64], dir: Direction, o: &Options) -> Vec<Point> {
    println!("--- {name}");
    let mut b = Branch::new(system, start, dir, o).unwrap();
    let mut v = vec![];
    let mut n=0;
    while let Some(p) = b.next() { n+=1; if p.kind != Kind::Regular { println!("{n} {:?} {:?} s={:.8} t={:?} other {:?}", p.kind, p.z, p.arclength, p.tangent, p.other); } v.push(p); }
    println!("points {} stop {:?}", v.len(), b.stop().map(|s| s.to_string()));
    v
}
#[test]
fn all() {
    let mut c = DenseSystem::new(1, &[0.0], 0, |x, p, g| g[0] = x[0]*x[0]+p[0]*p[0]-1.0);
    let e = Options{weights: Some(vec![1.0,1.0]), ..Options::within(-2.0,2.0)};
    trace("circle", &mut c, &[1.0,0.0], Direction::Increasing, &e);
    trace("circle default", &mut c, &[1.0,0.0], Direction::Increasing, &Options::within(-2.0,2.0));
    trace("circle from fold", &mut c, &[0.0,-1.0], Direction::Increasing, &Options::within(-2.0,2.0));
    let mut c = DenseSystem::new(1, &[0.0,1.0], 0, |x, p, g| g[0] = p[0]+p[1]*x[0]-x[0].powi(3));
    trace("cusp nf", &mut c, &[0.0,0.0], Direction::Increasing, &Options::within(-2.0,2.0));
    for k in [0.05,0.055,0.06] {
    let mut c = DenseSystem::new(1, &[16.0], 0, move |x, p, g| g[0] = x[0]*(1.0-x[0])*p[0]-(1.0+k*p[0]).powi(2));
    let a = 0.5+(0.25f64-(1.0f64+16.0*k).powi(2)/16.0).sqrt();
    trace("isola", &mut c, &[a,16.0], Direction::Increasing, &Options::within(1.0,100.0));
    }
    let mut c = DenseSystem::new(1, &[16.0], 0, move |x, p, g| g[0] = x[0]*(1.0-x[0])*p[0]-(1.0+0.05*p[0]).powi(2));
    trace("isola eu", &mut c, &[0.7179449471770336776118491,16.0], Direction::Increasing, &Options{weights:Some(vec![1.0,1.0]),largest_step:3.0,..Options::within(1.0,100.0)});
    for p2 in [14.0,15.0,16.0,17.0,18.0] {
    let mut c = DenseSystem::new(2, &[0.0,p2,3.0], 0, |u, p, g| { g[0] = -u[0]+p[0]*(1.0-u[0])*u[1].exp(); g[1]=-u[1]+p[0]*p[1]*(1.0-u[0])*u[1].exp()-p[2]*u[1]; });
    trace(&format!("tank {p2}"), &mut c, &[0.0,0.0,0.0], Direction::Increasing, &Options::within(-0.1,0.5));
    }
    let mut c = DenseSystem::new(1, &[0.0], 0, |x, p, g| g[0] = x[0]*(p[0]-x[0]*x[0]));
    let v = trace("pitchfork", &mut c, &[0.0,-1.0], Direction::Increasing, &Options::within(-1.0,2.0));
    let bp = v.iter().find(|p| p.kind==Kind::BranchPoint).unwrap();
    for leg in [Leg::Forward, Leg::Backward] {
      let o = Options::within(-1.0,2.0);
      let mut b = Branch::switch(&mut c, bp, leg, &o).unwrap();
      while let Some(p) = b.next() { println!("{:?} {:?}", p.kind, p.z); }
      println!("{:?}", b.stop());
    }
    trace("pitchfork side", &mut c, &[1.0,1.0], Direction::Decreasing, &Options::within(-1.0,2.0));
    let mut c = DenseSystem::new(1, &[0.0], 0, |x, p, g| g[0] = (x[0]-0.3*p[0])*(x[0]+p[0]-0.1) );
    trace("transcritical", &mut c, &[-0.3,-1.0], Direction::Increasing, &Options::within(-1.0,2.0));
    let mut c = DenseSystem::new(1, &[0.0], 0, |x, p, g| g[0] = x[0]*(p[0]-x[0]*x[0])+1e-3);
    trace("imperfect", &mut c, &[0.0,-1.0], Direction::Increasing, &Options::within(-1.0,2.0));
    let mut c = DenseSystem::new(1, &[0.0], 0, |x, p, g| g[0] = x[0]*(p[0]-x[0]*x[0])+1e-6);
    trace("imperfect 1e-6", &mut c, &[0.0,-1.0], Direction::Increasing, &Options::within(-1.0,2.0));
    let mut c = DenseSystem::new(1, &[0.0], 0, |x, p, g| g[0] = x[0]-p[0].ln());
    trace("log", &mut c, &[0.0,1.0], Direction::Decreasing, &Options::within(1e-8,2.0));
    println!("{:?}", Branch::new(&mut DenseSystem::new(1, &[0.0], 0, |x, p, g| g[0] = x[0]*x[0]-p[0]*p[0]), &[0.0,0.0], Direction::Increasing, &Options::within(-1.0,1.0)).err());
}
#[test] fn logg() {
    let mut c = DenseSystem::new(1, &[0.0], 0, |x, p, g| g[0] = x[0]-p[0].ln()).with_jacobian(|_x,p,j| {j[0]=1.0; j[1]=-1.0/p[0];});
    let o=Options::within(1e-8,2.0);
    let mut b = Branch::new(&mut c, &[0.0,1.0], Direction::Decreasing, &o).unwrap();
    while let Some(p) = b.next() { println!("{:?} {:?} {:?}", p.kind, p.z, p.arclength);}
    println!("{:?}", b.stop());
}
fn go<S: System>(name: &str, system: &mut S, start: &[f64], dir: Direction, o: &Options) -> Vec<Point> {
    println!("--- {name}");
    let mut b = Branch::new(system, start, dir, o).unwrap();
    let mut v = vec![];
    while let Some(p) = b.next() { println!("{:?} {:?} s={:.6}", p.kind, p.z, p.arclength);  v.push(p); }
    println!("points {} stop {:?}", v.len(), b.stop().map(|s| s.to_string()));
    v
}
#[test] fn curves() {
    let c = DenseSystem::new(1, &[0.3849001794597505096727659,1.0], 0, |x, p, g| g[0] = p[0]+p[1]*x[0]-x[0].powi(3)).with_second(1);
    let mut l = LimitPointCurve::new(c, &[-0.5773502691896257645091488, 0.3849001794597505096727659]).unwrap();
    let s = l.start(&[-0.5773502691896257645091488, 0.3849001794597505096727659]);
    go("fold curve nf", &mut l, &s, Direction::Decreasing, &Options::within(-0.5, 3.0));
    let tank = DenseSystem::new(2, &[0.0,18.0,3.0], 0, |u, p, g| { g[0] = -u[0]+p[0]*(1.0-u[0])*u[1].exp(); g[1]=-u[1]+p[0]*p[1]*(1.0-u[0])*u[1].exp()-p[2]*u[1]; }).with_second(1);
    let mut l = LimitPointCurve::new(tank, &[1.0/3.0,1.5,0.1115650800742149144666402]).unwrap();
    let s = l.start(&[1.0/3.0,1.5,0.1115650800742149144666402]);
    go("tank folds", &mut l, &s, Direction::Decreasing, &Options{targets: vec![17.0], ..Options::within(10.0, 20.0)});
    // isola birth: fold curve in (tau, kappa)
    let c = DenseSystem::new(1, &[16.0, 0.05], 0, move |x, p, g| g[0] = x[0]*(1.0-x[0])*p[0]-(1.0+p[1]*p[0]).powi(2)).with_second(1);
    let mut l = LimitPointCurve::new(c, &[0.5, 7.639320225002103]).unwrap();
    let s = l.start(&[0.5, 7.639320225002103]);
    go("isola folds", &mut l, &s, Direction::Increasing, &Options::within(0.0, 0.1));
    // branch point curve: x(λ - μ - x²)
    let c = DenseSystem::new(2, &[0.5, 0.5], 0, |x, p, g| {g[0] = x[0]*(p[0]-p[1]*p[1]-x[0]*x[0]); g[1]=x[1]-p[0]*x[0];}).with_second(1);
    let mut l = BranchPointCurve::new(c, &[0.0,0.0,0.25]).unwrap();
    let s = l.start(&[0.0,0.0,0.25]);
    go("bp curve", &mut l, &s, Direction::Increasing, &Options::within(0.0, 1.0));
    let c = DenseSystem::new(1, &[0.0, 0.0], 0, |x, p, g| {g[0] = x[0]*(p[0]-x[0]*x[0])+p[1];}).with_second(1);
    let mut l = BranchPointCurve::new(c, &[0.0,0.0]).unwrap();
    let s = l.start(&[0.0,0.0]);
    println!("{:?}", Branch::new(&mut l, &s, Direction::Increasing, &Options::within(-1.0, 1.0)).err());
    // deflation
    let mut c = DenseSystem::new(1, &[16.0], 0, move |x, p, g| {let b=(1.0-x[0])/(1.0+0.05*p[0]); g[0] = (1.0-x[0])/p[0]-x[0]*b*b;});
    let o=Options::within(1.0,100.0);
    let a = deflate(&mut c, &[vec![1.0,16.0]], &[0.9,16.0], &o).unwrap();
    println!("{a:?}");
    let b = deflate(&mut c, &[vec![1.0,16.0], a.clone()], &[0.9,16.0], &o).unwrap();
    println!("{b:?} {:?}", deflate(&mut c, &[vec![1.0,16.0], a.clone(), b.clone()], &[0.9,16.0], &o));
    let h = homotopy(&mut c, &b, 40.0, &o);
    println!("{h:?}");
    println!("{:?}", homotopy(&mut c, &b, 60.0, &o));
}
