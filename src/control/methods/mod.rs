//! The control methods: the one list of them, and what it makes.

mod convention;
mod delay;
mod ogy;
mod pulse;
mod sine;
mod sine_setting;

pub use self::convention::Convention;
pub use self::delay::{Delay, DelaySetting, Sign};
pub use self::ogy::{Ogy, OgySetting};
pub use self::pulse::{Pulse, PulseSetting};
pub use self::sine::Sine;
pub use self::sine_setting::SineSetting;

use serde::{Deserialize, Serialize};

use crate::control::action::{Action, Seen};
use crate::control::components::Components;
use crate::control::error::ControlError;
use crate::control::law::{Aim, Law, Method, Settings, Shown};
use crate::control::option::OptionKind::Word;
use crate::control::option::{Arguments, GivenOptions, MethodOption};
use crate::control::quantity::{AIMED, ControlQuantity};
use crate::control::site::{Site, exists};
use crate::control::target::TARGET_OPTIONS;
use crate::dynamics::Stop;
use crate::model::{Real, System};
use crate::system::Family;

/// Makes of the list of methods what holds any one of them.
macro_rules! methods {
    ($($(#[$doc:meta])* $Name:ident($Setting:ident)),+ $(,)?) => {
        /// Every method. Its code is its place, from 1; that of none is 0.
        pub const METHODS: &[&Method] = &[$(<$Setting as Settings>::METHOD),+];

        /// A control method with its settings.
        #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
        #[serde(rename_all = "lowercase", tag = "method")]
        pub enum Scheme {
            $($(#[$doc])* $Name($Setting)),+
        }

        impl Scheme {
            /// The scheme of a method that options make on a section, not checked.
            ///
            /// # Errors
            /// What is wrong with an option: the method does not have it, or not with such a value.
            ///
            /// # Panics
            /// If the method is none of [`METHODS`].
            pub fn given(method: &Method, options: &GivenOptions, site: &Site) -> Result<Self, ControlError> {
                method.check(options)?;
                match method.name {
                    $(name if name == <$Setting as Settings>::METHOD.name => {
                        Settings::given(options, site).map(Scheme::$Name)
                    })+
                    name => panic!("{name} is no method"),
                }
            }

            /// The method.
            pub fn method(&self) -> &'static Method {
                match self { $(Scheme::$Name(_) => <$Setting as Settings>::METHOD),+ }
            }

            /// The stop on whose section it acts.
            pub fn stop(&self) -> Stop {
                match self { $(Scheme::$Name(setting) => setting.stop),+ }
            }

            /// The same scheme with one setting changed (not checked); `None` if the method has no such setting.
            #[must_use]
            pub fn with(mut self, quantity: ControlQuantity, value: f64) -> Option<Self> {
                match &mut self { $(Scheme::$Name(setting) => setting.vary(quantity, value)?),+ }
                Some(self)
            }

            /// Checks every setting.
            ///
            /// # Errors
            /// The first setting that is out of range, with its value.
            pub fn check(&self) -> Result<(), ControlError> {
                match self { $(Scheme::$Name(setting) => setting.check()),+ }
            }

            /// The method in words, and what a picture shows of its settings.
            pub fn shown(&self) -> (&'static str, Vec<Shown>) {
                match self { $(Scheme::$Name(setting) => setting.shown()),+ }
            }

            fn write(&self, family: &Family, to: &mut Arguments) {
                match self { $(Scheme::$Name(setting) => setting.write(family, to)),+ }
            }

            fn law(&self, system: &System) -> Result<Controller<f64>, ControlError> {
                Ok(match self { $(Scheme::$Name(setting) => Controller::$Name(setting.resolve(system)?)),+ })
            }
        }

        /// One of the methods, at work on the section of a stop.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Controller<T> {
            /// No control; σ is that of the given stop.
            None(Stop),
            $($(#[$doc])* $Name($Name<T>)),+
        }

        impl<T: Real> Controller<T> {
            /// The stop on whose section it acts.
            pub fn stop(&self) -> Stop {
                match self { Controller::None(stop) => *stop, $(Controller::$Name(law) => law.stop),+ }
            }

            /// A controller rounded to another precision.
            pub fn rounded(controller: &Controller<f64>) -> Self {
                match controller {
                    Controller::None(stop) => Controller::None(*stop),
                    $(Controller::$Name(law) => Controller::$Name(Law::rounded(law))),+
                }
            }

            /// The controller without adaptation, its control signal as given, where one is.
            #[must_use]
            pub fn held(self, signal: Option<T>) -> Self {
                match self {
                    Controller::None(_) => self,
                    $(Controller::$Name(law) => Controller::$Name(law.held(signal))),+
                }
            }

            /// What it aims at: a point, or one component of it; none where it aims at nothing.
            pub fn target(&self) -> Option<Vec<T>> {
                match self { Controller::None(_) => None, $(Controller::$Name(law) => law.target()),+ }
            }

            /// Refuses what the GPU has no kernel for.
            ///
            /// # Errors
            /// What it is, and the remedy.
            pub fn check_on_device(&self) -> Result<(), &'static str> {
                match self { Controller::None(_) => Ok(()), $(Controller::$Name(law) => law.check_on_device()),+ }
            }

            /// Its method, if there is one, and what the shader reads of it: [`Method::members`], numbers as their bits.
            pub fn written(&self) -> Option<(&'static Method, Vec<u32>)> {
                match self {
                    Controller::None(_) => None,
                    $(Controller::$Name(law) => Some((<$Setting as Settings>::METHOD, law.written())),)+
                }
            }

            #[inline(always)]
            pub(in crate::control) fn act<const N: usize>(&mut self, seen: &Seen<T, N>) -> Action<T, N> {
                match self { Controller::None(_) => Action::none(), $(Controller::$Name(law) => law.act(seen)),+ }
            }

            #[inline(always)]
            pub(in crate::control) fn passed<const N: usize>(
                &self,
                seen: &Seen<T, N>,
                before: &[Components<T, N>],
                arrived: Components<T, N>,
            ) -> Components<T, N> {
                match self {
                    Controller::None(_) => arrived,
                    $(Controller::$Name(law) => law.passed(seen, before, arrived)),+
                }
            }

            pub(in crate::control) fn is_at_rest(&self) -> bool {
                match self { Controller::None(_) => true, $(Controller::$Name(law) => law.is_at_rest()),+ }
            }

            /// The coordinate that a force acts on between impacts, and γ; none for methods that change points only.
            pub fn force(&self) -> Option<(usize, T)> {
                match self { Controller::None(_) => None, $(Controller::$Name(law) => law.force()),+ }
            }

            pub(in crate::control) fn begins_anew(&self) -> bool {
                match self { Controller::None(_) => false, $(Controller::$Name(law) => law.begins_anew()),+ }
            }

            pub(in crate::control) fn remembered(&self) -> usize {
                match self { Controller::None(_) => 1, $(Controller::$Name(law) => law.remembered()),+ }
            }
        }
    };
}

methods! {
    /// An adapted sine force, Eqs. (21) to (23).
    Sine(SineSetting),
    /// Period pulses, Eqs. (26) to (29).
    Pulse(PulseSetting),
    /// Delayed feedback, Eq. (30).
    Delay(DelaySetting),
    /// Small kicks that hold an unstable motion.
    Ogy(OgySetting),
}

impl Scheme {
    /// The method at work on a system.
    ///
    /// # Errors
    /// A setting that is out of range or does not fit the system, or a target that does not exist.
    pub fn resolve(&self, system: &System) -> Result<Controller<f64>, ControlError> {
        self.check()?;
        exists("stop", self.stop().index(), system.plant().stops.len())?;
        self.law(system)
    }

    /// The options that make it again, those left out that an axis varies; the stop is named as in the family, where it is
    /// not the first.
    pub fn options(&self, family: &Family, varied: &dyn Fn(ControlQuantity) -> bool) -> String {
        let mut to = Arguments { text: String::new(), varied };
        if self.stop() != Stop::A {
            to.word("stop", &family.stops()[self.stop().index()].name);
        }
        self.write(family, &mut to);
        to.text
    }
}

impl Method {
    /// The method of a name.
    pub fn named(name: &str) -> Option<&'static Method> {
        METHODS.iter().copied().find(|method| method.name == name)
    }

    /// Its option of a name, that of the stop and those of a target among them.
    pub fn option(&self, name: &str) -> Option<&'static MethodOption> {
        let aimed = TARGET_OPTIONS.iter().filter(|_| self.aim != Aim::Nothing);
        self.options.1.iter().chain(aimed).chain([&STOP_OPTION]).find(|own| own.name == name)
    }

    /// Refuses options that it does not have, and values that are none of theirs.
    fn check(&self, options: &GivenOptions) -> Result<(), ControlError> {
        options.0.iter().try_for_each(|(name, value)| match self.option(name) {
            None => Err(ControlError::Option(format!("--{name} has no effect on {}: drop it", self.name))),
            Some(option) => option.check(value),
        })
    }

    /// Whether an option has no effect beside a setting that something else sets.
    pub fn replaces(&self, quantity: ControlQuantity, option: &MethodOption) -> bool {
        // Of pulses it replaces only one component of the target.
        let whole_target = AIMED.contains(&quantity) && self.aim == Aim::Component;
        let own = quantity.option();
        option.name == own
            || option.instead_of == Some(&own)
            || whole_target && TARGET_OPTIONS.iter().any(|of_target| of_target.name == option.name)
    }

    /// The options of all methods, with the heading of each and what its help begins with.
    pub fn options() -> Vec<(&'static str, String, MethodOption)> {
        let own = METHODS.iter().flat_map(|method| {
            let (heading, options) = method.options;
            options.iter().map(move |&option| (heading, format!("{}: ", method.name), option))
        });
        let aiming = METHODS.iter().filter(|method| method.aim != Aim::Nothing).map(|method| method.name);
        let aiming = format!("{}: ", Vec::from_iter(aiming).join(", "));
        std::iter::once(("Section", String::new(), STOP_OPTION))
            .chain(own)
            .chain(TARGET_OPTIONS.map(|option| ("Target", aiming.clone(), option)))
            .collect()
    }
}

/// The option of the stop, which all methods have.
const STOP_OPTION: MethodOption = MethodOption::new(Word, ["stop", "NAME"], "The stop at whose impacts control acts, by name [default: the first of the system's]",
)
.more(
    "X, a point on its section, has 2n components: the velocity after the impact of the coordinate that the stop's gap \
     determines (the one with the largest share of its direction), the other displacements, the other velocities, the \
     forcing phase: v1+, x2, v2, tau at either stop of the paper's oscillator.",
);

impl ControlQuantity {
    /// Every setting that an axis can vary.
    pub fn all() -> impl Iterator<Item = ControlQuantity> {
        METHODS.iter().flat_map(|method| method.varied.iter().copied()).chain(AIMED)
    }

    /// Those that there are in systems of n coordinates.
    pub fn of_coordinates(n: usize) -> impl Iterator<Item = ControlQuantity> {
        let exists = move |aimed: &Self| (0..n).any(|own| aimed.component(n, own).is_some());
        Self::all().filter(move |setting| !AIMED.contains(setting) || exists(setting))
    }
}
