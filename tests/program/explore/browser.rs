//! Chromium, driven by chromedriver.

use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use fantoccini::actions::{InputSource, MouseActions, PointerAction};
use fantoccini::{Client, ClientBuilder, Locator};
use hyper_util::client::legacy::connect::HttpConnector;
use serde_json::{Value, json};

/// How long anything may take.
const PATIENCE: Duration = Duration::from_secs(90);

/// A browser with one window.
pub struct Browser {
    driver: Child,
    pub page: Client,
}

impl Browser {
    /// Starts a browser without a screen, with a window of a size.
    pub async fn start(width: u32, height: u32) -> Self {
        let mut driver = Command::new("chromedriver")
            .arg("--port=0")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("chromedriver runs: install chromium and chromium-driver");
        let lines = BufReader::new(driver.stdout.take().unwrap()).lines().map(Result::unwrap);
        let port: u16 = lines
            .filter_map(|line| line.split_once("successfully on port ").map(|(_, port)| port.to_owned()))
            .map(|port| port.trim_end_matches('.').parse().unwrap())
            .next()
            .expect("chromedriver says its port");
        let arguments = [
            "--headless=new",
            "--no-sandbox",
            "--disable-dev-shm-usage",
            "--force-device-scale-factor=1",
            "--hide-scrollbars",
            "--disable-gpu",
            &format!("--window-size={width},{height}"),
        ];
        let options = json!({ "goog:chromeOptions": { "args": arguments } });
        let Value::Object(capabilities) = options else { unreachable!() };
        let page = ClientBuilder::new(HttpConnector::new())
            .capabilities(capabilities)
            .connect(&format!("http://127.0.0.1:{port}"))
            .await
            .expect("chromium starts");
        let browser = Browser { driver, page };
        browser.resize(width, height).await;
        browser
    }

    /// Makes the page itself so large, as a phone's is, whatever the window's frame takes.
    pub async fn resize(&self, width: u32, height: u32) {
        let metrics = json!({ "cmd": "Emulation.setDeviceMetricsOverride",
            "params": { "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600 } });
        self.devtools(metrics).await;
    }

    /// Shows the page as in the dark.
    pub async fn scheme(&self, scheme: &str) {
        let features = json!([{ "name": "prefers-color-scheme", "value": scheme }]);
        self.devtools(json!({ "cmd": "Emulation.setEmulatedMedia", "params": { "features": features } }))
            .await;
    }

    async fn devtools(&self, command: Value) {
        let session = self.page.session_id().await.unwrap().unwrap();
        self.page.issue_cmd(Devtools { session, command }).await.unwrap();
    }

    /// What a script returns.
    pub async fn run(&self, script: &str) -> Value {
        self.page.execute(script, Vec::new()).await.unwrap()
    }

    /// Waits until a script returns something true.
    pub async fn until(&self, what: &str, script: &str) -> Duration {
        let began = Instant::now();
        while self.run(&format!("return Boolean({script})")).await != json!(true) {
            assert!(began.elapsed() < PATIENCE, "{what} does not come: {script}");
            tokio::time::sleep(Duration::from_millis(25)).await;
        }
        began.elapsed()
    }

    /// Waits until everything in sight is there, and its legend.
    pub async fn settled(&self) {
        let script = "globalThis.explorer && document.querySelector('#plane').dataset.known === 'true' \
                      && Number(document.querySelector('#plane').dataset.share) === 1 \
                      && document.querySelector('#legend tr td')";
        self.until("the whole view", script).await;
        // The legend's paints come last.
        tokio::time::sleep(Duration::from_millis(500)).await;
    }

    /// Presses the mouse at places of the plane's plot, from the first to the last.
    pub async fn drag(&self, places: &[[f64; 2]]) {
        let script = "const r = document.querySelector('#plane canvas').getBoundingClientRect(); return [r.left, r.top]";
        let corner: [f64; 2] = serde_json::from_value(self.run(script).await).unwrap();
        let moved = |[x, y]: [f64; 2]| PointerAction::MoveTo {
            duration: Some(Duration::from_millis(30)),
            x: (corner[0] + x).round(),
            y: (corner[1] + y).round(),
        };
        let mut actions = MouseActions::new("mouse".into()).then(moved(places[0]));
        actions = actions.then(PointerAction::Down { button: 0 });
        for &place in &places[1..] {
            actions = actions.then(moved(place));
        }
        self.page.perform_actions(actions.then(PointerAction::Up { button: 0 })).await.unwrap();
    }

    /// Types keys on the plane.
    pub async fn type_on_plane(&self, keys: &str) {
        self.page.find(Locator::Css("#plane")).await.unwrap().send_keys(keys).await.unwrap();
    }

    /// Keeps a picture of the page where a person can look.
    pub async fn screenshot(&self, name: &str) -> PathBuf {
        let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("explorer-{name}.png"));
        std::fs::write(&path, self.page.screenshot().await.unwrap()).unwrap();
        path
    }

    /// Ends the browser.
    pub async fn close(mut self) {
        let _ = self.page.clone().close().await;
        let _ = self.driver.kill();
        let _ = self.driver.wait();
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.driver.kill();
    }
}

/// A command of Chromium's own tools.
#[derive(Debug)]
struct Devtools {
    session: String,
    command: Value,
}

impl fantoccini::wd::WebDriverCompatibleCommand for Devtools {
    fn endpoint(&self, base: &url::Url, _: Option<&str>) -> Result<url::Url, url::ParseError> {
        base.join(&format!("session/{}/goog/cdp/execute", self.session))
    }

    fn method_and_body(&self, _: &url::Url) -> (http::Method, Option<String>) {
        (http::Method::POST, Some(self.command.to_string()))
    }
}
