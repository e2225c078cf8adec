//! Where a kernel keeps what it notes about its trajectory.

use super::kernel::Kernel;

/// Where the observer of a trajectory is while that is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(test, derive(strum::VariantArray))]
pub enum Residence {
    /// In memory of the workgroup: hardware has some by its registers, which are few.
    Workgroup,
    /// In memory of the invocation: a software adapter has nothing that is nearer.
    Private,
}

impl Residence {
    /// Whether the observer of a kernel is one of those of its workgroup: only what is stored is large.
    fn is_among_others(self, kernel: Kernel) -> bool {
        self == Residence::Workgroup && kernel.stores_observer()
    }

    /// What `observer` stands for in a kernel.
    pub fn observer(self, kernel: Kernel) -> &'static str {
        if self.is_among_others(kernel) { "observers_here[lane]" } else { "observer" }
    }

    /// Declares the observer, and for kernels that store one how they go on with it and store it.
    pub fn source(self, kernel: Kernel) -> String {
        let observer = self.observer(kernel);
        let declared = if self.is_among_others(kernel) {
            "var<workgroup> observers_here: array<Observer, WORKGROUP>;\n"
        } else {
            "var<private> observer: Observer;\n"
        };
        if !kernel.stores_observer() {
            return declared.to_owned();
        }
        format!(
            "{declared}
// Goes on with an observer that was stored.
fn observer_resume() {{
    {observer} = observers[cell].observer;
    trajectory = observers[cell].trajectory;
    tangent = observers[cell].tangent;
}}

fn observer_save() {{
    observers[cell] = Observed(trajectory, tangent, {observer});
}}
"
        )
    }
}
