//! What the figure of an orbit shows.

use impact_atlas::render::{OrbitPanel, Zoom};
use impact_atlas::system::Family;

use super::options::SystemArgs;
use super::{Result, defaults, wrong};

/// The plots of the figure.
pub struct Shown {
    pub panels: Vec<OrbitPanel>,
    /// The ranges of their axes that were asked for.
    pub zooms: Vec<Zoom>,
    /// Forcing periods of the sections; 0 where none is shown.
    pub section_periods: u32,
}

impl Shown {
    /// What the options name by the words of the system; of a figure that is not drawn there are no panels.
    ///
    /// # Errors
    /// A word that names nothing, or an option without effect.
    pub fn of(
        options: &SystemArgs,
        panels: Option<&[String]>,
        zooms: &[String],
        section_periods: Option<u32>,
    ) -> Result<Self> {
        let family = options.family();
        let panel = |text: &String| options.named("--panel <NAME[:X,Y]>", text, OrbitPanel::of_family);
        let zoom = |text: &String| options.named("--zoom <NAME=LOW:HIGH>", text, Zoom::of_family);
        let panels = match panels {
            None => Vec::new(),
            Some([]) => vec![OrbitPanel::portrait(family), OrbitPanel::time_series(family)],
            Some(panels) => panels.iter().map(panel).collect::<Result<_>>()?,
        };
        let shows_sections = panels.iter().any(|panel| panel.is_section());
        if let (false, Some(periods)) = (shows_sections, section_periods) {
            return Err(wrong!(
                "--section-periods {periods} has no effect, since no panel is a section: drop it or add a --panel"
            ));
        }
        let section_periods =
            if shows_sections { section_periods.unwrap_or(defaults::SECTION_PERIODS) } else { 0 };
        let zooms = zooms.iter().map(zoom).collect::<Result<_>>()?;
        let shown = Shown { panels, zooms, section_periods };
        shown.check(family)?;
        Ok(shown)
    }

    /// A range that no plot shows is a mistake.
    fn check(&self, family: &Family) -> Result<()> {
        for (i, zoom) in self.zooms.iter().enumerate() {
            let name = zoom.name(family);
            let of = zoom.variable.name(family);
            if !self.panels.iter().any(|panel| panel.axes().contains(&zoom.variable)) {
                return Err(wrong!(
                    "--zoom {name} has no effect, since no panel has an axis over {of}: drop it or add a --panel"
                ));
            }
            if let Some(other) = self.zooms[..i].iter().find(|other| other.variable == zoom.variable) {
                return Err(wrong!(
                    "{of} has two ranges, --zoom {} and --zoom {name}: drop one of the two",
                    other.name(family)
                ));
            }
        }
        Ok(())
    }
}
