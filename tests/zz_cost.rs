mod common;
use common::Bench;
use shadowlab::{gl, hard, labs, scene};
#[repr(C)]
struct Ts { s: i64, n: i64 }
unsafe extern "C" { fn clock_gettime(id: i32, t: *mut Ts) -> i32; }
fn cpu() -> f64 {
    let mut t = Ts { s: 0, n: 0 };
    unsafe { clock_gettime(2, &mut t) };
    t.s as f64 * 1e3 + t.n as f64 / 1e6
}
#[test]
fn cost() {
    let five = || scene::file::load(std::path::Path::new("assets/five_shapes.toml"), false).unwrap();
    let lab = |n: &str| (labs::find(n).unwrap().scene)().unwrap();
    let rounds: usize = std::env::var("ROUNDS").map_or(30, |r| r.parse().unwrap());
    let cs: &[&[&str]] = &[&["filter=linear"], &["filter=nearest"], &["shadow_test=offset"], &["shadow_test=offset", "filter=nearest"], &["shadow_test=exact"]];
    let cc: &[&[&str]] = &[&[], &["shadow_test=offset"], &["stage=pcf"], &["shadow_test=offset", "stage=pcf"], &["shadow_test=exact"]];
    let room: &[&[&str]] = &[&["scene=room"], &["scene=room", "shadow_test=offset"], &["scene=room", "shadow_test=exact"]];
    let pick: Option<usize> = std::env::var("PICK").ok().map(|p| p.parse().unwrap());
    let only = std::env::var("ONLY").unwrap_or_default();
    for (name, l, s, states) in [
        ("five", "cs541", five(), cs), ("cs541", "cs541", lab("cs541"), cs),
        ("bumpy 200k", "cs541", (hard::find("bumpy").unwrap().scene)(), cs),
        ("csci", "csci3260", lab("csci3260"), cc), ("room", "csci3260", lab("csci3260"), room),
    ] {
        if !name.contains(&only) { continue; }
        let mut benches: Vec<Bench> = states[..1].iter().map(|st| {
            let context = shadowlab::headless::Headless::open(&shadowlab::headless::Choice::Software, [800, 600], false).unwrap();
            let folder = std::env::var("GLSL").ok();
            let mut lab = (labs::find(l).unwrap().start)(&context.gl, s.clone(), folder.as_ref().map(|f| std::path::Path::new(f))).unwrap();
            lab.resize([800, 600]);
            let mut b = Bench { lab, context, size: [800, 600] };
            b.set(st);
            b.set(&["redraw=every_frame"]);
            b
        }).collect();
        // One bench's context is current last: make one bench only
        benches.truncate(1);
        let mut b = benches.pop().unwrap();
        let start = b.lab.settings().clone();
        let mut t = vec![vec![[0.0; 2]; rounds]; states.len()];
        for r in 0..rounds {
            for i in 0..states.len() {
                let i = pick.unwrap_or((i + r) % states.len());
                *b.lab.settings() = start.clone();
                b.set(&["redraw=every_frame"]);
                b.set(states[i]);
                for k in 0..3 {
                    if k == 2 { b.set(&["redraw=when_changed"]); }
                    gl::finish(&b.context.gl);
                    let c = cpu();
                    b.render();
                    gl::finish(&b.context.gl);
                    if k > 0 { t[i][r][k - 1] = cpu() - c; }
                }
            }
        }
        for (i, st) in states.iter().enumerate() {
            let med = |k: usize, rel: bool| { let mut v: Vec<f64> = (0..rounds).map(|r| if rel { t[i][r][k] / t[0][r][k] } else { t[i][r][k] }).collect(); v.sort_by(f64::total_cmp); v[rounds / 2] };
            println!("{name:12}{:45} frame {:.3} ({:.2} ms cpu)  rest {:.3} ({:.2} ms)", st.join(" "), med(0, true), med(0, false), med(1, true), med(1, false));
        }
    }
}
