//! A journey through a plane in a real browser.

use std::collections::HashMap;

use fantoccini::Locator;
use fantoccini::key::Key;
use impact_atlas::backend::{Choice, Unwatched, open};
use impact_atlas::curves::bifurcation_curves;
use impact_atlas::plane::{Plane, RegionMap};
use impact_atlas::render::{Motion, Shown, live_legend, live_lines};
use impact_atlas::sweep::sweep;
use serde_json::{Value, json};
use tempfile::tempdir;

use crate::explore::browser::Browser;
use crate::explore::proxy::{PREFIX, Proxy};
use crate::explore::server::{Explorer, SMALL};

/// The colours of the canvas at the middles of the plane's cells, row by row, the lowest row first.
const PIXELS: &str = "
    const { view, paint, state } = explorer;
    const { width, height, data } = paint.image;
    const colours = [];
    for (let j = 0; j < state.scene.y.count; j++) for (let i = 0; i < state.scene.x.count; i++) {
        const [px, py] = view.pixelAt(i, j);
        const at = 4 * (Math.floor(py * paint.ratio) * width + Math.floor(px * paint.ratio));
        colours.push('#' + [0, 1, 2].map((c) => (data[at + c] ?? 0).toString(16).padStart(2, '0')).join(''));
    }
    return colours;";

/// The map of the small plane with some parameters changed, computed here.
fn map(changed: &[(&str, f64)]) -> RegionMap {
    let plane = Plane {
        x: "omega=1.2:3.6:96".parse().unwrap(),
        y: "delta=0.08:0.3:72".parse().unwrap(),
        parameters: changed.iter().fold(
            impact_atlas::model::Parameters::default().into(),
            |setting: impact_atlas::model::Setting, (name, value)| setting.with_named(name, *value),
        ),
        start: impact_atlas::plane::Start::Symmetric,
        task: impact_atlas::analysis::Schedule {
            transient: 80,
            observe: 48,
            max_period: 32,
            fixed_periods: false,
        },
    };
    sweep(&plane, &*open(Choice::Cpu, None).unwrap(), &Unwatched).unwrap()
}

/// For each cell of a map, the ground and the hatch of its motion in the map's picture.
fn paints(map: &RegionMap) -> Vec<(String, Option<String>)> {
    let mut numbers: HashMap<Motion, usize> = HashMap::new();
    let mut found: Vec<(Motion, u64)> = Vec::new();
    let cells: Vec<usize> = map
        .verdicts
        .iter()
        .map(|verdict| {
            let number = *numbers.entry(Motion::of(verdict)).or_insert_with(|| {
                found.push((Motion::of(verdict), 0));
                found.len() - 1
            });
            found[number].1 += 1;
            number
        })
        .collect();
    let legend = live_legend(map.plane.parameters.family(), true, &found, 14);
    cells.into_iter().map(|cell| legend.paints[cell].clone()).collect()
}

/// How many of the cells have other colours on the page than in a map's picture.
fn differing(colours: &Value, paints: &[(String, Option<String>)]) -> usize {
    let colours = colours.as_array().unwrap();
    assert_eq!(colours.len(), paints.len());
    let same = |(colour, (ground, hatch)): (&Value, &(String, Option<String>))| {
        colour == ground || hatch.as_ref().is_some_and(|hatch| colour == hatch)
    };
    colours.iter().zip(paints).filter(|pair| !same(*pair)).count()
}

/// A hash of what the canvas shows.
const SEEN: &str =
    "let h = 0; for (const p of explorer.paint.pixels) h = (Math.imul(h, 31) + p) | 0; return h;";

#[tokio::test(flavor = "multi_thread")]
async fn a_plane_is_opened_and_clicked_and_changed_and_found_again() {
    let folder = tempdir().unwrap();
    let explorer = Explorer::start(folder.path(), SMALL);
    let browser = Browser::start(1280, 800).await;
    browser.page.goto(&explorer.address).await.unwrap();
    browser.settled().await;

    // The picture is that of `map`, cell by cell.
    let own = map(&[]);
    let expected = paints(&own);
    let colours = browser.run(PIXELS).await;
    assert_eq!(differing(&colours, &expected), 0);
    let shifted: Vec<_> = expected[1..].iter().chain(&expected[..1]).cloned().collect();
    assert!(differing(&colours, &shifted) > 100, "one cell to the side, nothing differs");

    // A click shows the cell's motion and its portrait.
    let at = browser.run("const [x, y] = explorer.view.pixelAt(70, 40); return [x, y]").await;
    let at: [f64; 2] = serde_json::from_value(at).unwrap();
    browser.drag(&[at]).await;
    browser.until("a portrait", "document.querySelector('.card .portrait svg')").await;
    browser.until("exponents", "document.querySelector('.card .exponents li')").await;
    browser.until("other starts", "document.querySelector('.card .coexisting li')").await;
    let cell = browser.run("return explorer.panel.current.cell").await;
    let [z, i, j]: [i64; 3] = serde_json::from_value(cell).unwrap();
    let shown = browser.page.find(Locator::Css(".card h2")).await.unwrap().text().await.unwrap();
    let on_plane = |at: i64| (at as f64 * 2_f64.powi(-(z as i32))).round() as u32;
    assert_eq!(shown, Motion::name(own.at(on_plane(i), on_plane(j)), true));
    browser.screenshot("1280x800").await;

    // It is kept beside the next one.
    browser.page.find(Locator::Css(".card header button")).await.unwrap().click().await.unwrap();
    browser.drag(&[[at[0] - 200.0, at[1] + 40.0]]).await;
    browser.until("two cards", "document.querySelectorAll('.card').length === 2").await;

    // The view is found again under its address.
    for _ in 0..3 {
        browser.type_on_plane("+").await;
    }
    browser.type_on_plane(&Key::Left.to_string()).await;
    browser.settled().await;
    let zoomed = browser.run(SEEN).await;
    assert_ne!(differing(&browser.run(PIXELS).await, &expected), 0);
    let address = browser.page.current_url().await.unwrap();
    browser.page.refresh().await.unwrap();
    browser.settled().await;
    assert_eq!(browser.run(SEEN).await, zoomed);
    browser.until("the card", "document.querySelector('.card .portrait svg')").await;

    // A second tab sees the same.
    let first = browser.page.window().await.unwrap();
    let second = browser.page.new_window(true).await.unwrap().handle;
    browser.page.switch_to_window(second).await.unwrap();
    browser.resize(1280, 800).await;
    browser.page.goto(address.as_str()).await.unwrap();
    browser.settled().await;
    assert_eq!(browser.run(SEEN).await, zoomed);
    browser.page.close_window().await.unwrap();
    browser.page.switch_to_window(first).await.unwrap();

    // Another parameter is another plane, and going back goes back.
    browser.type_on_plane("0").await;
    browser.settled().await;
    let field = browser.page.find(Locator::Css("input[aria-label='r']")).await.unwrap();
    field.click().await.unwrap();
    browser.run("document.activeElement.select()").await;
    field.send_keys("0.6\u{e007}").await.unwrap();
    browser.until("another plane", "explorer.state.scene.plane.set.r === 0.6 && !explorer.state.stale").await;
    browser.settled().await;
    let changed = browser.run(PIXELS).await;
    assert_eq!(differing(&changed, &paints(&map(&[("r", 0.6)]))), 0);
    assert!(differing(&changed, &expected) > 100);
    browser.page.back().await.unwrap();
    browser
        .until("the plane before", "explorer.state.scene.plane.set.r === 0.8 && !explorer.state.stale")
        .await;
    browser.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_lost_connection_comes_back_behind_a_proxy_with_a_path() {
    let folder = tempdir().unwrap();
    let explorer = Explorer::start(folder.path(), SMALL);
    let proxy = Proxy::start(explorer.port()).await;
    let browser = Browser::start(1000, 700).await;
    let address = format!("http://127.0.0.1:{}{PREFIX}/{}/", proxy.port, explorer.token());
    browser.page.goto(&address).await.unwrap();
    browser.settled().await;
    let seen = browser.run(SEEN).await;
    proxy.cut();
    browser.until("a notice", "document.querySelector('.notice[data-name=link]')").await;
    // What was there can still be looked at.
    assert_eq!(browser.run(SEEN).await, seen);
    proxy.mend();
    browser.until("the connection", "!document.querySelector('.notice') && explorer.link.isOpen").await;
    browser.type_on_plane("+").await;
    browser.settled().await;
    assert_ne!(browser.run(SEEN).await, seen);
    browser.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn own_systems_slices_layers_and_small_screens() {
    let folder = tempdir().unwrap();
    let explorer = Explorer::start(folder.path(), SMALL);
    let browser = Browser::start(390, 844).await;
    browser.page.goto(&explorer.address).await.unwrap();
    browser.settled().await;
    let wide = "return document.documentElement.scrollWidth <= innerWidth";
    assert_eq!(browser.run(wide).await, json!(true), "the page is wider than the phone");
    browser.screenshot("390x844").await;
    browser.scheme("dark").await;
    browser.screenshot("390x844-dark").await;

    // A system of one's own: what is wrong is told with its line, what is right is followed.
    browser.resize(1280, 800).await;
    let write = |text: &str| {
        format!(
            "const area = document.querySelector('.system textarea'); area.closest('details').open = true; area.value = {}; \
             [...document.querySelectorAll('button')].find((b) => b.textContent === 'Use this system').click();",
            json!(text)
        )
    };
    let family = impact_atlas::system::builtin("shaw-holmes").unwrap();
    browser.run(&write(&family.replace("frequency = \"omega\"", "frequency = \"omegga\""))).await;
    browser.until("the error", "!document.querySelector('.error').hidden").await;
    let error = browser.page.find(Locator::Css(".error")).await.unwrap().text().await.unwrap();
    let line = 1 + family.lines().position(|line| line.starts_with("frequency")).unwrap();
    assert!(error.contains(&format!(":{line}")) && error.contains("omegga"), "{error}");
    browser.run(&write(&family.replacen("name = \"", "name = \"My ", 1))).await;
    browser
        .until("one's own system", "document.querySelector('#system-name').textContent.startsWith('My ')")
        .await;
    browser
        .until(
            "its cells",
            "document.querySelector('#plane').dataset.known === 'true' && !explorer.state.stale",
        )
        .await;
    browser.drag(&[[200.0, 200.0]]).await;
    browser.until("a portrait", "document.querySelector('.card .portrait svg')").await;

    // A layer of numbers has a colour bar.
    browser.run("const s = document.querySelector('#tools select'); s.value = 'lyapunov'; s.dispatchEvent(new Event('change'))").await;
    browser
        .until("a colour bar", "explorer.paint.scale && !document.querySelector('#legend .bar').hidden")
        .await;
    browser.until("its colours", "new Set(explorer.paint.pixels).size > 8").await;

    // One that is measured when it is looked at has its own.
    let before = browser.run("return [...explorer.paint.pixels].join()").await;
    browser.run("const s = document.querySelector('#tools select'); s.value = 'rms.x1'; s.dispatchEvent(new Event('change'))").await;
    let shown = "document.querySelector('#plane').dataset.known === 'true' && new Set(explorer.paint.pixels).size > 8";
    browser.until("the colours of a measured layer", shown).await;
    assert_ne!(browser.run("return [...explorer.paint.pixels].join()").await, before);

    // A line through the plane gives a diagram.
    browser
        .run("[...document.querySelectorAll('#tools button')].find((b) => b.textContent === 'Slice').click()")
        .await;
    browser.drag(&[[60.0, 120.0], [200.0, 160.0], [330.0, 300.0]]).await;
    browser.until("a diagram", "document.querySelector('#slice svg')").await;
    browser.screenshot("1280x800-dark").await;
    // So does one whose ends are set by keys; without its second end it gives none.
    browser.run("explorer.slice.close()").await;
    browser.type_on_plane(&Key::Enter.to_string()).await;
    let moved = format!("{}{}{}", Key::Shift, Key::Right.to_string().repeat(25), Key::Null);
    // An end that is set twice is no line, and Escape forgets it.
    browser.type_on_plane(&Key::Enter.to_string()).await;
    browser.type_on_plane(&moved).await;
    assert_eq!(browser.run("return explorer.slice.line !== null").await, json!(true));
    browser.type_on_plane(&Key::Escape.to_string()).await;
    browser.type_on_plane(&moved).await;
    assert_eq!(browser.run("return [explorer.slice.line, explorer.slice.begun]").await, json!([null, null]));
    browser.type_on_plane(&Key::Enter.to_string()).await;
    browser.type_on_plane(&moved.replace(&Key::Right.to_string(), &Key::Left.to_string())).await;
    assert_eq!(browser.run("return document.querySelector('#slice').hidden").await, json!(true));
    browser.type_on_plane(&Key::Enter.to_string()).await;
    browser.until("a diagram by keys", "document.querySelector('#slice svg')").await;
    browser.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn curves_lie_over_the_plane_and_say_what_they_are() {
    let folder = tempdir().unwrap();
    let explorer = Explorer::start(folder.path(), SMALL);
    let browser = Browser::start(1280, 800).await;
    browser.page.goto(&explorer.address).await.unwrap();
    browser.settled().await;
    let pressed =
        "[...document.querySelectorAll('#tools button')].find((b) => b.textContent === 'Curves').click()";
    browser.run(pressed).await;
    browser.until("curves", "document.querySelectorAll('.curves .felt').length > 0").await;
    let about =
        "return [...document.querySelectorAll('.curves .felt title')].map((title) => title.textContent)";
    let about: Vec<String> = serde_json::from_value(browser.run(about).await).unwrap();
    let map = map(&[]);
    let found = bifurcation_curves(&map, 2).unwrap().curves;
    let lines: Vec<String> =
        live_lines(&map, &found, Shown::Bounding).into_iter().map(|line| line.about).collect();
    assert!(about.len() > 4 && about.iter().all(|line| lines.contains(line)), "{about:?}\n{lines:?}");
    assert!(about.iter().any(|line| line.contains("pitchfork")), "{about:?}");
    // One that has a name has it written beside it, in its own colour.
    browser.until("a name", "document.querySelectorAll('.curves .curve-name').length > 0").await;
    browser.screenshot("curves-1280x800").await;
    // They stay where they belong when the plane moves, and go when they are not wanted.
    let first = "return document.querySelector('.curves .felt').getAttribute('d')";
    let before = browser.run(first).await;
    browser.drag(&[[300.0, 300.0], [340.0, 320.0]]).await;
    assert_ne!(browser.run(first).await, before);
    browser.run(pressed).await;
    browser.until("no curves", "document.querySelectorAll('.curves .felt').length === 0").await;

    // Those of a part say where they were followed once more than that is in sight.
    browser.type_on_plane("0++").await;
    browser.settled().await;
    browser.run(pressed).await;
    browser.until("curves of a part", "document.querySelectorAll('.curves .felt').length > 0").await;
    let outlined = "return document.querySelectorAll('.curves .followed').length";
    assert_eq!(browser.run(outlined).await, json!(0));
    browser.type_on_plane("0").await;
    browser.until("their part", "document.querySelectorAll('.curves .followed').length === 2").await;
    browser.screenshot("part-1280x800").await;

    // However long labels are, they stand apart from the title of their axis.
    let apart = "const title = document.querySelectorAll('.axes .name')[1].getBoundingClientRect(); \
         return [...document.querySelectorAll('.axes text[text-anchor=end]')].map((label) => label.getBoundingClientRect().left - title.right)";
    let long = "Math.max(...[...document.querySelectorAll('.axes text[text-anchor=end]')].map((label) => label.textContent.length)) > 9";
    browser.type_on_plane(&"+".repeat(40)).await;
    browser.until("long labels", long).await;
    browser.settled().await;
    let gaps: Vec<f64> = serde_json::from_value(browser.run(apart).await).unwrap();
    assert!(gaps.len() > 2 && gaps.iter().all(|gap| *gap > 0.0), "{gaps:?}");
    browser.screenshot("deep-1280x800").await;
    browser.close().await;
}
