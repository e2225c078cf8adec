//! What a page shows after it was changed, left, or opened with something that there is not: always the plane that is open.

use fantoccini::Locator;
use serde_json::{Value, json};
use tempfile::tempdir;

use crate::explore::browser::Browser;
use crate::explore::server::{Explorer, SMALL};

/// The axes of the plane that is open.
const AXES: &str = "return [explorer.state.scene.x.text, explorer.state.scene.y.text]";

impl Browser {
    /// Types into a field of the controls in place of what is there, and whatever `end` is after it.
    async fn fill(&self, name: &str, text: &str, end: &str) {
        let field = self.page.find(Locator::Css(&format!("[aria-label='{name}']"))).await.unwrap();
        field.click().await.unwrap();
        self.run("document.activeElement.select()").await;
        field.send_keys(&format!("{text}{end}")).await.unwrap();
    }

    /// What stands in a field.
    async fn field(&self, name: &str) -> Value {
        self.run(&format!("return document.querySelector(\"[aria-label='{name}']\").value")).await
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn fields_are_those_of_the_plane_that_is_open() {
    let folder = tempdir().unwrap();
    let explorer = Explorer::start(folder.path(), SMALL);
    let browser = Browser::start(1280, 800).await;
    browser.page.goto(&explorer.address).await.unwrap();
    browser.settled().await;
    browser
        .run("document.querySelectorAll('#controls details').forEach((group) => { group.open = true; })")
        .await;
    let first = browser.run(AXES).await;

    // One change after the other, the focus going on by Tab: what is selected there is typed over.
    browser.fill("across: from", "1.5", "\t").await;
    browser.until("the first change", "explorer.state.scene.x.first === 1.5").await;
    assert_eq!(
        browser.run("return document.activeElement.getAttribute('aria-label')").await,
        json!("across: to")
    );
    let active = browser.page.active_element().await.unwrap();
    active.send_keys("3\t").await.unwrap();
    browser.until("both changes", "explorer.state.scene.x.text.startsWith('omega=1.5:3:')").await;
    browser.fill("across: cells", "50", "\u{e007}").await;
    browser.until("all changes", "explorer.state.scene.x.text === 'omega=1.5:3:50'").await;

    // What is refused does not stay there, nor what was left by going back.
    browser.fill("r", "5", "\u{e007}").await;
    browser.until("a notice", "document.querySelector('.notice')").await;
    assert_eq!(browser.field("r").await, json!("0.8"));
    for _ in 0..3 {
        browser.page.back().await.unwrap();
        browser.until("a plane", "explorer.state.pending == null && explorer.state.scene").await;
    }
    browser.until("the first plane", &format!("explorer.state.scene.x.text === {}", first[0])).await;
    assert_eq!(browser.field("across: from").await, json!("1.2"));
    browser.fill("transient", "-1", "\u{e007}").await;
    browser
        .until("a mark", "document.querySelector(\"[aria-label='transient'][aria-invalid='true']\")")
        .await;

    // A component of the start goes as far as the stops let it, and a start can be typed.
    let choose = |name: &str, value: &str| {
        format!(
            "const s = document.querySelector(\"select[aria-label='{name}']\"); s.closest('details').open = true; \
             s.value = '{value}'; s.dispatchEvent(new Event('change'));"
        )
    };
    browser.run(&choose("start", "state")).await;
    browser.until("a field", "!document.querySelector(\"[aria-label='start state']\").hidden").await;
    browser.run(&choose("start", "rest")).await;
    browser.until("rest", "explorer.state.scene.start === 'rest'").await;
    browser.run(&choose("across: what", "x1")).await;
    browser.until("starts", "explorer.state.scene.x.text.startsWith('x1=-0.08:0.08:')").await;
    browser.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_plane_that_was_left_is_found_again_with_its_names_and_views() {
    let folder = tempdir().unwrap();
    let explorer = Explorer::start(folder.path(), SMALL);
    let browser = Browser::start(1280, 800).await;
    browser.page.goto(&explorer.address).await.unwrap();
    browser.settled().await;

    // A turn of the wheel is a step that going back undoes.
    let whole = browser.run("return explorer.view.window").await;
    let steps = browser.run("return history.length").await;
    browser
        .run(
            "const plane = document.querySelector('#plane'), box = plane.getBoundingClientRect(); \
             plane.dispatchEvent(new WheelEvent('wheel', { deltaY: -200, cancelable: true, \
             clientX: box.left + 300, clientY: box.top + 200 }));",
        )
        .await;
    browser.until("a step", &format!("history.length > {steps}")).await;
    assert_ne!(browser.run("return explorer.view.window").await, whole);
    browser.page.back().await.unwrap();
    browser.until("the view before", &format!("String(explorer.view.window) === String({whole})")).await;

    // A kept card marks a cell of its own plane alone.
    browser.drag(&[[300.0, 200.0]]).await;
    browser.until("a card", "explorer.panel.current").await;
    browser.page.find(Locator::Css(".card header button")).await.unwrap().click().await.unwrap();
    browser.until("a ring", "document.querySelector('.ring.kept')").await;
    browser.fill("r", "0.7", "\u{e007}").await;
    browser.until("another plane", "explorer.state.scene.plane.set.r === 0.7 && !explorer.state.stale").await;
    browser.settled().await;
    browser.until("no ring", "!document.querySelector('.ring')").await;
    browser.page.back().await.unwrap();
    browser
        .until("the plane before", "explorer.state.scene.plane.set.r === 0.8 && !explorer.state.stale")
        .await;
    browser.settled().await;
    browser.until("the ring again", "document.querySelector('.ring.kept')").await;
    assert_ne!(browser.run("return explorer.state.motions.length").await, json!(0), "motions have names");
    browser.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_address_that_leads_nowhere_says_so() {
    let folder = tempdir().unwrap();
    let explorer = Explorer::start(folder.path(), SMALL);
    let browser = Browser::start(1280, 800).await;
    for (wrong, part) in [("system=nosuch", "does not come with"), ("system=luo-ma-lv&set.r=7", "r = 7")] {
        browser.page.goto("about:blank").await.unwrap();
        browser.page.goto(&format!("{}#{wrong}", explorer.address)).await.unwrap();
        browser.settled().await;
        let notices = browser.run("return document.querySelector('#notices').textContent").await;
        assert!(notices.as_str().unwrap().contains(part), "{wrong}: {notices}");
    }
    // Views that cannot be looked at are the whole plane.
    for view in ["10,1,10,1", "5,5,5,5", "1e300,2e300,0,1", "1e9,1.1e9,0,1e8"] {
        browser.page.goto("about:blank").await.unwrap();
        let address = format!("{}#system=luo-ma-lv&view={view}", explorer.address);
        browser.page.goto(&address).await.unwrap();
        browser.until("a plane", "globalThis.explorer?.state.scene").await;
        browser.until(view, "String(explorer.view.window) === String(explorer.view.whole)").await;
    }
    // A program that was started anew has another address: the old one is not tried for ever.
    browser.page.goto(&explorer.address).await.unwrap();
    browser.settled().await;
    let port = explorer.port().to_string();
    drop(explorer);
    browser.until("a notice", "document.querySelector('.notice[data-name=link]')").await;
    browser.fill("r", "0.6", "\u{e007}").await;
    browser
        .until("no connection", "document.querySelector('#notices').textContent.includes('no connection')")
        .await;
    let _anew = Explorer::start(folder.path(), &format!("{SMALL} --port {port}"));
    browser
        .until(
            "its address",
            "document.querySelector('.notice[data-name=link]').textContent.includes('started anew')",
        )
        .await;
    browser.close().await;
}
