//! Pictures from data: the same as those of `map`, of any part, of any layer.

use std::fs;
use std::path::Path;

use image::RgbImage;
use tempfile::tempdir;

use super::SMALL;
use crate::run::{done, json, run_in, stderr, words};

fn pixels(path: &Path) -> RgbImage {
    image::open(path).unwrap().to_rgb8()
}

#[test]
fn a_picture_from_data_is_the_picture_of_the_map() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    done(folder.path(), &format!("{SMALL} --out map.png --size 800x600"));
    done(folder.path(), &format!("{SMALL} --data plane.zarr --tile 5 --out stored.png --size 800x600"));
    done(folder.path(), "render map.npz --out npz.png --size 800x600");
    done(folder.path(), "render plane.zarr --out zarr.png --size 800x600");
    let map = pixels(&at("map.png"));
    for name in ["stored.png", "npz.png", "zarr.png"] {
        assert!(map == pixels(&at(name)), "{name}");
    }
    done(folder.path(), "render map.npz --out other.png --size 800x600 --no-legend");
    assert!(map != pixels(&at("other.png")));
}

#[test]
fn every_layer_is_drawn_in_every_format() {
    let folder = tempdir().unwrap();
    done(folder.path(), &format!("{SMALL} --data plane.zarr --extents"));
    let family = impact_atlas::system::Family::paper();
    let layers = impact_atlas::plane::fields::Layer::all(family);
    assert!(layers.len() >= 6);
    for layer in layers {
        let name = layer.name();
        done(folder.path(), &format!("render plane.zarr --out {name}.svg --layer {name}"));
        let svg = fs::read_to_string(folder.path().join(format!("{name}.svg"))).unwrap();
        assert!(svg.contains("impact-atlas render plane.zarr"), "{name}");
        assert_eq!(svg.contains("&quot;layer&quot;:"), name != "motion", "{name}");
    }
    done(folder.path(), "render plane.zarr --out p.pdf --layer lyapunov --palette purple-green --title Test");
    let pdf = fs::read(folder.path().join("p.pdf")).unwrap();
    assert!(pdf.starts_with(b"%PDF") && pdf.windows(6).any(|part| part == b"/Image"), "{}", pdf.len());
}

#[test]
fn a_zoom_shows_its_cells_alone() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    done(folder.path(), &format!("{SMALL} --out map.png"));
    // Columns 3 to 8 of 12, rows 2 to 5 of 9, as a map of their own.
    let axis = |first: f64, last: f64, count: u32, from: u32, to: u32| {
        let at = |i: u32| first + (last - first) * f64::from(i) / f64::from(count - 1);
        (at(from), at(to))
    };
    let ((a, b), (c, d)) = (axis(2.6, 3.9, 12, 3, 8), axis(0.05, 0.3, 9, 2, 5));
    done(
        folder.path(),
        &format!("render map.npz --out zoom.png --size 700x500 --no-legend --x {a}:{b} --y {c}:{d}"),
    );
    let own = format!(
        "map --backend cpu --x omega={a}:{b}:6 --y delta={c}:{d}:4 --transient 40 --observe 40 --out own.png \
         --size 700x500 --no-legend"
    );
    done(folder.path(), &own);
    assert!(pixels(&at("zoom.png")) == pixels(&at("own.png")));
}

#[test]
fn curves_of_a_table_are_drawn() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    done(folder.path(), &format!("{SMALL} --out map.png --size 600x450"));
    let table = "curve,kind,motion,x,y,criticality,point,symmetric,bounding\n\
                 1,fold,1-1-1,2.7,0.06,,ordinary,true,true\n1,fold,1-1-1,3.2,0.2,,cusp,true,true\n\
                 1,fold,1-1-1,9,0.28,,ordinary,true,true\n";
    fs::write(at("curves.csv"), table).unwrap();
    done(folder.path(), "render map.npz --out curves.png --size 600x450 --curves curves.csv");
    assert!(pixels(&at("map.png")) != pixels(&at("curves.png")));
    done(folder.path(), "render map.npz --out curves.svg --size 600x450 --curves curves.csv");
    let svg = fs::read_to_string(at("curves.svg")).unwrap().replace("&quot;", "\"");
    assert!(svg.contains(r#""curves":{"shown":"bounding","max_period":null}"#));
    done(folder.path(), "render map.npz --out all.svg --size 600x450 --curves curves.csv --curves-shown all");
    let all = fs::read_to_string(at("all.svg")).unwrap().replace("&quot;", "\"");
    assert!(all.contains(r#""curves":{"shown":"all","max_period":null}"#));
    // The curves that `map` draws and writes are those that are drawn from its table.
    done(folder.path(), &format!("{SMALL} --out drawn.png --size 600x450 --curves --curves-out drawn.csv"));
    done(folder.path(), "render drawn.npz --out again.png --size 600x450 --curves drawn.csv");
    assert!(pixels(&at("drawn.png")) == pixels(&at("again.png")));
    assert!(pixels(&at("drawn.png")) != pixels(&at("map.png")));
}

#[test]
fn a_map_is_made_again_from_its_picture_its_data_or_its_store() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    done(folder.path(), &format!("{SMALL} --set r=0.7 --out map.png"));
    done(folder.path(), &format!("{SMALL} --set r=0.7 --data plane.zarr"));
    let data = fs::read(at("map.npz")).unwrap();
    for (i, from) in ["map.png", "map.npz", "plane.zarr"].into_iter().enumerate() {
        done(folder.path(), &format!("map --from {from} --out again{i}.png"));
        assert!(fs::read(at(&format!("again{i}.npz"))).unwrap() == data, "{from}");
    }
    // The store itself goes on from its own configuration.
    let again = "map --from plane.zarr --data plane.zarr --json";
    assert_eq!(json(&run_in(folder.path(), &words(again)))["tiles_computed"], 0);
    done(folder.path(), "map --from map.png --set r=0.8 --x omega=2.7:3.9:5 --out changed.png");
    let expected = SMALL.replace("omega=2.6:3.9:12", "omega=2.7:3.9:5");
    done(folder.path(), &format!("{expected} --out expected.png"));
    assert!(fs::read(at("changed.npz")).unwrap() == fs::read(at("expected.npz")).unwrap());
    let output = run_in(folder.path(), &["map", "--from", "curves.csv"]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    let output = run_in(folder.path(), &["map", "--from", "map.png", "--system", "bouncing-ball", "--force"]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("drop --system"), "{}", stderr(&output));
}
