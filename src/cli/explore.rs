//! `impact-atlas explore`: a plane in the browser.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::Duration;

use anyhow::anyhow;
use clap::Args;
use impact_atlas::backend::Choice;
use impact_atlas::explore::{self, Asked, Computing, Guard, Known, Served, Server, choosable};
use impact_atlas::plane::Plane;
use impact_atlas::store::{ZarrStore, read_map};

use super::options::{BackendArgs, PlaneArgs};
use super::terminal::print;
use super::{CliError, Result, interrupt, note, wrong};

/// How often the server looks for Ctrl-C.
const GLANCE: Duration = Duration::from_millis(50);

/// Shows a plane in the browser: move through it, click on it, take it along
///
/// The page is served by this program, on this machine alone, under an address with a token that is printed. It computes
/// what is in view, coarse first, and on a click shows the motion that moves there. On another machine's screen it is
/// reached through an SSH tunnel: ssh -L PORT:127.0.0.1:PORT MACHINE. It ends with Ctrl-C.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas explore
  impact-atlas explore --open
  impact-atlas explore --x omega=2.4:3.8:400 --y r=0.5:0.95:300 --set delta=0.1 --port 8080
  impact-atlas explore --system bouncing-ball
  impact-atlas explore --data map.npz")]
#[command(mut_arg("reproducible", |arg| arg.hide(true)))]
pub struct ExploreArgs {
    #[command(flatten)]
    plane: PlaneArgs,

    #[command(flatten)]
    backend: BackendArgs,

    /// Begins with the plane of an archive or a store that `map` wrote; its cells are not computed again
    ///
    /// A tile of a store that is not there is kept in it as soon as all its cells were looked at, if the back end is the
    /// store's own and the store is not certified. Of a store of more than 8 million cells seen from afar, cells are computed
    /// where that is sooner done than reading their tile.
    #[arg(long, value_name = "FILE.npz|STORE.zarr", conflicts_with_all = ["x", "y", "family", "assignments", "start",
        "transient", "observe", "max_period", "fixed_periods"])]
    data: Option<PathBuf>,

    /// Listens on this port of 127.0.0.1 [default: any that is free]
    #[arg(long, value_name = "PORT")]
    port: Option<u16>,

    /// Opens the page in the browser of this machine
    #[arg(long)]
    open: bool,

    /// Also answers under this name, as behind a proxy; may be repeated
    ///
    /// A request for any other name than this machine's own is refused, so that no page from elsewhere gets in.
    #[arg(long = "allow-host", value_name = "NAME")]
    hosts: Vec<String>,
}

/// Runs the command.
pub fn run(args: &ExploreArgs) -> Result<()> {
    let (plane, known) = match &args.data {
        Some(path) => {
            let known = read(path)?;
            (known.plane().clone(), Some(known))
        }
        None => (args.plane.plane()?, None),
    };
    explore::check(&plane).map_err(CliError::input)?;
    let computing = computing(&args.backend)?;
    // The adapters are looked for before anybody waits for a page.
    choosable();
    let server = server(args, plane, computing, known)?;
    let address = server.address().map_err(CliError::machine)?;
    print(&address)?;
    note(&format!("computing on {}: {}; Ctrl-C ends", computing.backend.name(), computing.backend.adapter()));
    if args.open
        && let Err(error) = open::that_detached(&address)
    {
        note(&format!("no browser could be opened ({error}): open the address above in one"));
    }
    let ended = async {
        while !interrupt::requested() {
            tokio::time::sleep(GLANCE).await;
        }
    };
    server.run(ended).map_err(CliError::machine)?;
    interrupt::check()
}

fn server(args: &ExploreArgs, plane: Plane, computing: Computing, known: Option<Known>) -> Result<Server> {
    let guard = Guard::new(&args.hosts)
        .map_err(|error| CliError::Machine(anyhow!("the machine gives no chance for a token: {error}")))?;
    let served = Served::new(plane, computing, known).map_err(CliError::machine)?;
    let port = args.port.unwrap_or(0);
    Server::bind(port, guard, served).map_err(|error| {
        CliError::Machine(anyhow!(
            "cannot listen on port {port} of 127.0.0.1 ({error}): choose another with --port, or drop it for any that \
             is free"
        ))
    })
}

/// The back end that is asked for.
fn computing(args: &BackendArgs) -> Result<Computing> {
    if args.reproducible {
        return Err(wrong!(
            "--reproducible is for results in files, and the explorer's back end can be changed in the page: use map \
             --reproducible"
        ));
    }
    let asked = match (args.backend, &args.adapter) {
        (Choice::Cpu, Some(adapter)) => {
            return Err(wrong!(
                "--adapter {adapter} chooses an adapter of the GPU back end: drop it or --backend cpu"
            ));
        }
        (_, Some(adapter)) => Asked::adapter(adapter)?,
        (Choice::Auto, None) => Asked::Auto,
        (Choice::Gpu, None) => Asked::Gpu,
        (Choice::Cpu, None) => Asked::Cpu,
    };
    Ok(explore::open(asked)?)
}

/// The cells of an archive, or of a store as far as they are there.
fn read(path: &Path) -> Result<Known> {
    let name = path.display();
    if path.is_dir() {
        return Ok(Known::of_store(ZarrStore::open(path)?)?);
    }
    let wrong = |error: anyhow::Error| {
        CliError::Input(error.context(format!(
            "`{name}` cannot be explored: give an npz file or a store that `map` wrote, of a plane without control"
        )))
    };
    let file =
        File::open(path).map_err(|error| wrong!("cannot read `{name}`: {error}; is the name right?"))?;
    let map = read_map(file).map_err(|error| wrong(error.into()))?;
    map.plane.check().map_err(|error| wrong(error.into()))?;
    small_enough(&name.to_string(), &map.plane)?;
    Ok(map.into())
}

/// Refuses planes that do not fit into memory with their tiles.
fn small_enough(name: &str, plane: &Plane) -> Result<()> {
    if plane.cells() <= Known::MOST {
        return Ok(());
    }
    Err(wrong!(
        "`{name}` has {} cells, and at most {} of an archive are explored: put the plane into a store, with `map --from` it \
         and --data STORE.zarr",
        plane.cells(),
        Known::MOST
    ))
}
