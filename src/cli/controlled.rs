//! The options of planes under control, which `map` and `validate` share.

use std::path::Path;

use clap::Args;
use impact_atlas::control::{ControlSchedule, Method};
use impact_atlas::plane::{Control, Plane};

use super::method::{MethodArgs, method, varied};
use super::options::PlaneArgs;
use super::values::count;
use super::{Result, defaults, wrong};

/// Control of every cell of a plane.
#[derive(Debug, Args)]
pub struct ControlledArgs {
    /// Controls every cell by a method, and maps what is reached
    #[arg(long, value_name = "METHOD", value_parser = method(), help_heading = "Control", long_help = format!("\
Controls every cell by a method, and maps what is reached

Axes may vary the settings of the method too: {}; target_v1 … target_vn, target_x1 … target_xn, target_tau. See \
`impact-atlas control --help` for what they are.", varied()),
        conflicts_with_all = ["transient", "observe", "fixed_periods", "curves"])]
    pub control: Option<&'static Method>,

    /// With --control, the first iterate that is controlled [default: 200]; without, for `map`, a picture, an npz file or a
    /// store whose configuration is run again, with what else is given in its place
    #[arg(long, value_name = "N|FILE", help_heading = "Control")]
    from: Option<String>,

    #[arg(long, value_parser = count, value_name = "K", requires = "control", help_heading = "Control",
        help = format!("Iterates altogether; a cell that has settled under control finishes early [default: {}]",
            defaults::CONTROL_MAP_ITERATES))]
    iterates: Option<u32>,

    #[command(flatten)]
    settings: MethodArgs,
}

impl ControlledArgs {
    /// Refuses settings of a method, and another option of control that was given, where there is no method.
    pub fn refuse_settings(&self, other: Option<&str>) -> Result<()> {
        // The parser waives that an option requires --control where one that conflicts with it is given, too.
        match self.settings.any().or(self.iterates.map(|_| "iterates")).or(other) {
            Some(option) => Err(wrong!(
                "--{option} has no effect without control: drop it or choose a method with --control"
            )),
            None => Ok(()),
        }
    }

    /// The file whose configuration is run again, if there is one.
    pub fn again(&self) -> Option<&Path> {
        self.from.as_deref().filter(|_| self.control.is_none()).map(Path::new)
    }

    /// The first iterate that is controlled.
    fn first(&self) -> Result<u32> {
        let Some(text) = &self.from else { return Ok(defaults::CONTROL_MAP_FROM) };
        count(text).map_err(|error| {
            wrong!(
                "invalid value '{text}' for '--from <N|FILE>': with --control it is the first iterate that is controlled: \
                 {error}"
            )
        })
    }

    /// The checked plane under control.
    pub fn plane(&self, method: &Method, plane: &PlaneArgs) -> Result<Plane<Control>> {
        let max_period = plane.max_period.unwrap_or(ControlSchedule::MAX_PERIOD);
        let from = self.first()?;
        let iterates = self.iterates.unwrap_or(defaults::CONTROL_MAP_ITERATES);
        let schedule = ControlSchedule { from, iterates, fixed: false, max_period };
        plane.control_plane(method, &self.settings, schedule)
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use impact_atlas::control::Scheme;
    use impact_atlas::model::Setting;

    use super::*;
    use crate::cli::Cli;
    use crate::cli::compared::Compared;

    #[derive(Parser)]
    struct Wrapper {
        #[command(flatten)]
        plane: PlaneArgs,
        #[command(flatten)]
        control: ControlledArgs,
    }

    fn plane(words: &str) -> Plane<Control> {
        let wrapper = Wrapper::parse_from(std::iter::once("map").chain(words.split_whitespace()));
        wrapper.control.plane(wrapper.control.control.unwrap(), &wrapper.plane).unwrap()
    }

    /// The system and the scheme of a cell.
    fn cell(plane: &Plane<Control>, column: u32, row: u32) -> (Setting, Scheme) {
        (plane.parameters_at(column, row), plane.scheme_at(column, row))
    }

    #[test]
    fn a_cell_alone_is_the_cell_of_the_plane() {
        for words in [
            "--control delay --x omega=2.8:2.9:3 --y gain=0.1:0.5:4 --delay 2 --sign printed --set zeta=0.09",
            "--control delay --x delay=1:3:3 --y r=0.7:0.8:4 --gains 0.1,0.2,0.3,0.4 --from 20 --iterates 90",
            "--control pulse --x target_v1=-0.5:-0.1:3 --y target_tau=1:3:4 --noise 0.001 --seed 7",
            "--control pulse --x omega=2.8:2.9:3 --y period=1:4:4 --target=-0.3,0.01,0.02,1.8 --start=0,0.1,0,0",
            "--control sine --x dead_band=0:0.1:3 --y amplitude=-0.3:0.3:4 --convention force --phase -1.5",
            "--control sine --x omega=2.8:2.9:3 --y gamma=0.5:2:4 --component v_after --target -0.3 --alpha 0.05",
            "--control sine --x omega=2.8:2.9:3 --y target_tau=1:2:4 --alpha 0.05 --max-period 20",
            "--control delay --x omega=2.8:2.9:3 --y gain=0.1:0.5:4 --set delay=3 --set mu_c=1e-7",
        ] {
            let plane = plane(words);
            let command = Compared::Controlled(&plane).command(2, 1, "--backend gpu");
            Cli::try_parse_from(command.split_whitespace()).unwrap();
            let options = command.strip_prefix("impact-atlas validate ").unwrap();
            let alone = self::plane(options.split(" --backend").next().unwrap());
            assert_eq!(cell(&alone, 0, 0), cell(&plane, 2, 1), "{command}");
            assert_eq!((alone.start, alone.task.schedule), (plane.start, plane.task.schedule), "{command}");
            assert_ne!(cell(&alone, 0, 0), cell(&plane, 0, 0));
        }
    }
}
