//! Adapters: what this machine offers, and the one that was asked for.

use derive_more::Display;
use serde::Serialize;

use crate::backend::{BackendError, Result};

/// The graphics interfaces that are asked for; never GL, which wgpu would otherwise fall back to in silence.
const INTERFACES: wgpu::Backends =
    wgpu::Backends::VULKAN.union(wgpu::Backends::METAL).union(wgpu::Backends::DX12);

/// What an adapter says of itself.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Display)]
#[display("{name} ({api}, {driver}, {kind})")]
pub struct AdapterReport {
    /// The device's name.
    pub name: String,
    /// The driver's name and version.
    pub driver: String,
    /// Vulkan, Metal or Dx12.
    pub api: String,
    /// "hardware" or "software".
    pub kind: String,
    /// The address on the PCI bus, domain:bus:device.function; empty where there is none or it is not told.
    pub pci: String,
}

impl AdapterReport {
    fn new(info: &wgpu::AdapterInfo) -> Self {
        let kind = if info.device_type == wgpu::DeviceType::Cpu { "software" } else { "hardware" };
        AdapterReport {
            name: info.name.clone(),
            driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
            api: info.backend.to_string(),
            kind: kind.to_owned(),
            pci: info.device_pci_bus_id.to_lowercase(),
        }
    }

    /// Whether the adapter computes on the processor.
    pub fn is_software(&self) -> bool {
        self.kind == "software"
    }

    /// Whether a text means this adapter, the one of an index in the list of all: `#` and the index, the address on the PCI
    /// bus, or a part of the description.
    fn is_meant(&self, index: usize, text: &str) -> bool {
        if let Some(number) = text.strip_prefix('#') {
            return number.parse() == Ok(index);
        }
        let at = |address: &str| address.to_lowercase().trim_start_matches('0').to_owned();
        (!self.pci.is_empty() && at(&self.pci) == at(text))
            || self.to_string().to_lowercase().contains(&text.to_lowercase())
    }
}

/// An adapter and what it says of itself.
pub struct Found {
    /// The adapter.
    pub adapter: wgpu::Adapter,
    /// Its description.
    pub report: AdapterReport,
}

/// Every adapter of this machine, hardware first.
pub fn adapters() -> Vec<AdapterReport> {
    all().into_iter().map(|found| found.report).collect()
}

fn all() -> Vec<Found> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: INTERFACES,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let mut found: Vec<Found> = pollster::block_on(instance.enumerate_adapters(INTERFACES))
        .into_iter()
        .map(|adapter| Found { report: AdapterReport::new(&adapter.get_info()), adapter })
        .collect();
    found.sort_by_key(|found| match found.adapter.get_info().device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    });
    found
}

/// The best adapter that a text means: see [`AdapterReport::is_meant`].
pub fn find(text: Option<&str>) -> Result<Found> {
    let mut found = all();
    let listed: Vec<String> = found.iter().map(|found| found.report.to_string()).collect();
    let is_meant = |(i, found): (usize, &Found)| text.is_none_or(|text| found.report.is_meant(i, text));
    let position = found.iter().enumerate().position(is_meant);
    match (position, text) {
        (Some(position), _) => Ok(found.swap_remove(position)),
        (None, Some(text)) if !listed.is_empty() => Err(BackendError::NoAdapter(format!(
            "no adapter matches `{text}`; there is: {}",
            listed.join("; ")
        ))),
        (None, _) => Err(BackendError::NoAdapter(
            "this machine has no Vulkan, Metal or DX12 adapter; install a driver (on Debian the software adapter is \
             mesa-vulkan-drivers), or use --backend cpu"
                .to_owned(),
        )),
    }
}

/// The best adapter that is not a software one.
pub fn find_hardware() -> Option<Found> {
    all().into_iter().find(|found| !found.report.is_software())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn adapters_are_meant_by_index_address_or_name() {
        let report = AdapterReport {
            name: "NVIDIA H100".into(),
            driver: "550".into(),
            api: "vulkan".into(),
            kind: "hardware".into(),
            pci: "0000:3b:00.0".into(),
        };
        // The driver's own tool writes the domain with eight digits.
        for text in ["#2", "0000:3b:00.0", "00000000:3B:00.0", "h100", "vulkan, 550"] {
            assert!(report.is_meant(2, text), "{text}");
        }
        for text in ["#1", "#", "#x", "0000:3c:00.0", "0000:3b:00", "a100"] {
            assert!(!report.is_meant(2, text), "{text}");
        }
        let without = AdapterReport { pci: String::new(), ..report };
        assert!(!without.is_meant(0, "0000"), "no address is no address");
    }
}
