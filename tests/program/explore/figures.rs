//! How fast it is, and how much memory it takes; not a test but a measurement: run it with `--ignored --nocapture`.

use std::time::{Duration, Instant};

use serde_json::json;
use tempfile::tempdir;

use crate::explore::browser::Browser;
use crate::explore::server::Explorer;

const KNOWN: &str = "globalThis.explorer && document.querySelector('#plane').dataset.known === 'true'";

#[tokio::test(flavor = "multi_thread")]
#[ignore = "a measurement of minutes"]
async fn how_long_it_takes() {
    let folder = tempdir().unwrap();
    let explorer = Explorer::start(folder.path(), "--backend cpu");
    let browser = Browser::start(1280, 800).await;
    let began = Instant::now();
    browser.page.goto(&explorer.address).await.unwrap();
    browser.until("the coarse plane", KNOWN).await;
    println!("opening to the first whole coarse plane: {:.2} s", began.elapsed().as_secs_f64());
    let marks = "return performance.getEntriesByType('mark').map((m) => `${m.name} ${Math.round(m.startTime)}`).join(', ')";
    println!("processor time of the program: {:.2} s", explorer.processor_time().as_secs_f64());
    println!("in milliseconds of the page: {}", browser.run(marks).await);

    let mut clicks = Vec::new();
    for k in 0..25 {
        browser.run("delete document.body.dataset.portrait").await;
        let place = [40.0 + f64::from(k * 83 % 520), 40.0 + f64::from(k * 131 % 540)];
        browser.drag(&[place]).await;
        browser.until("a portrait", "document.body.dataset.portrait").await;
        let took = browser.run("return Number(document.body.dataset.portrait)").await;
        clicks.push(took.as_f64().unwrap());
        tokio::time::sleep(Duration::from_millis(700)).await;
    }
    clicks.sort_by(f64::total_cmp);
    println!(
        "click to portrait: {:.0} ms median, {:.0} ms largest of {}",
        clicks[12],
        clicks[24],
        clicks.len()
    );

    let (began, spent) = (Instant::now(), explorer.processor_time());
    let whole = "Number(document.querySelector('#plane').dataset.share) === 1";
    while browser.run(&format!("return {whole}")).await != json!(true)
        && began.elapsed() < Duration::from_secs(400)
    {
        tokio::time::sleep(Duration::from_millis(500)).await;
    }
    let share = browser.run("return Number(document.querySelector('#plane').dataset.share)").await;
    println!(
        "then to {:.1} % of the cells in sight: {:.1} s, {:.1} s of processor time",
        100.0 * share.as_f64().unwrap(),
        began.elapsed().as_secs_f64(),
        (explorer.processor_time() - spent).as_secs_f64()
    );

    for k in 0..500 {
        let (dx, dy) = if k % 100 < 50 { (37, 11) } else { (-37, -11) };
        browser
            .run(&format!(
                "explorer.view.move({dx}, {dy}); window.dispatchEvent(new Event('resize')); \
            explorer.tiles.look(explorer.view, [400, 300]);"
            ))
            .await;
    }
    tokio::time::sleep(Duration::from_secs(5)).await;
    let page = browser.run("return performance.memory.usedJSHeapSize").await.as_f64().unwrap();
    let program = explorer.memory() as f64;
    println!("after 500 moves: the program {:.0} MB, the page {:.0} MB", program / 1e6, page / 1e6);
    assert!(program < 1.5e9, "{program} bytes");
    browser.close().await;
}
