//! The metadata of a store: a group with the configuration, an array for every field, and the axes.

use std::path::Path;
use std::sync::Arc;

use serde_json::{Map, Value, json};
use zarrs::array::codec::array_to_bytes::sharding::ShardingCodecBuilder;
use zarrs::array::codec::{
    ArrayToBytesCodecTraits, BytesToBytesCodecTraits, CodecOptions, Crc32cCodec, GzipCodec,
};
use zarrs::array::{Array, ArrayBuilder, ChunkShape, DataType, Element, FillValue};
use zarrs::filesystem::FilesystemStore;
use zarrs::group::GroupBuilder;
use zarrs::storage::store::MemoryStore;

use crate::analysis::Regime;
use crate::plane::fields::{CellField, Extras, Inner, Kind, NOT_COMPUTED};
use crate::plane::{Axis, Component, Plane, Provenance, Quantity, Tiling};

/// The format of stores that this version writes and reads.
pub const FORMAT: u64 = 1;

/// How hard shards are compressed: hardly, since writing must not cost computing time.
const COMPRESSION: u32 = 1;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error + Send + Sync>>;

/// What makes a store.
#[derive(Clone, Copy, Debug)]
pub struct Skeleton<'a> {
    /// The plane.
    pub plane: &'a Plane,
    /// What computes it.
    pub provenance: &'a Provenance,
    /// The configuration, as every file carries it.
    pub configuration: &'a Value,
    /// What its cells have beyond verdicts.
    pub extras: Extras,
    /// Its tiles.
    pub tiling: Tiling,
}

impl Skeleton<'_> {
    /// Writes an empty store into a folder that is there.
    pub fn write(&self, folder: &Path) -> Result<()> {
        let store = Arc::new(FilesystemStore::new(folder)?);
        let mut consolidated = Map::new();
        for field in CellField::of_plane(self.extras) {
            let array = self.field(field, store.clone())?;
            array.store_metadata()?;
            consolidated.insert(field.name.to_owned(), serde_json::to_value(array.metadata())?);
        }
        for (name, axis) in [("x", &self.plane.x), ("y", &self.plane.y)] {
            let array = coordinates(name, axis, store.clone())?;
            array.store_metadata()?;
            array.store_chunk_elements(&[0], &axis.values())?;
            consolidated.insert(name.to_owned(), serde_json::to_value(array.metadata())?);
        }
        let mut group = GroupBuilder::new();
        group.attributes(self.attributes());
        // Readers that know it need not look for the arrays.
        let all = json!({ "kind": "inline", "must_understand": false, "metadata": consolidated });
        let fields = json!({ "consolidated_metadata": all });
        group.additional_fields(serde_json::from_value(fields)?);
        group.build(store, "/")?.store_metadata()?;
        Ok(())
    }

    fn attributes(&self) -> Map<String, Value> {
        let family = self.plane.parameters.family();
        let parameters: Map<String, Value> =
            self.plane.parameters.entries().map(|(p, value)| (p.name().to_owned(), value.into())).collect();
        let title = format!(
            "{}: what every cell's trajectory settles on over {} and {}",
            family.name,
            self.plane.x.quantity.name(),
            self.plane.y.quantity.name()
        );
        let attributes = json!({
            "title": title,
            "source": format!("impact-atlas {}", self.provenance.version),
            "impact_atlas_format": FORMAT,
            "version": self.provenance.version,
            "backend": self.provenance.backend,
            "adapter": self.provenance.adapter,
            "system": family.name,
            "parameters": parameters,
            "start": self.plane.start.to_string(),
            "tile": self.tiling.side,
            "config": self.configuration.to_string(),
        });
        let Value::Object(attributes) = attributes else { unreachable!("it is written as an object") };
        attributes
    }

    /// The array of a field: a shard for every tile, of one chunk, with checksums.
    fn field(&self, field: &CellField, store: Arc<FilesystemStore>) -> Result<Array<FilesystemStore>> {
        let family = self.plane.parameters.family();
        let inner = field.inner.dimensions(family);
        let shape = field.shape(self.plane);
        let shard = [&[u64::from(self.tiling.side); 2][..], &shape[2..]].concat();
        let chunk: ChunkShape = shard.as_slice().try_into()?;
        let mut sharding = ShardingCodecBuilder::new(chunk);
        sharding.bytes_to_bytes_codecs(of_chunks()?);
        let (kind, fill) = kind_and_fill(field);
        let names: Vec<&str> = ["y", "x"].into_iter().chain(inner.iter().map(|(name, _)| *name)).collect();
        Ok(ArrayBuilder::new(shape, shard, kind, fill)
            .array_to_bytes_codec(Arc::new(sharding.build()))
            .dimension_names(Some(names))
            .attributes(self.about(field))
            .build(store, &format!("/{}", field.name))?)
    }

    /// The attributes of a field, by the names that the CF conventions have for them.
    fn about(&self, field: &CellField) -> Map<String, Value> {
        let family = self.plane.parameters.family();
        let mut about = Map::new();
        about.insert("long_name".to_owned(), field.title.into());
        if !field.unit.is_empty() {
            about.insert("units".to_owned(), field.unit.into());
        }
        about.insert("description".to_owned(), field.meaning.into());
        if field.name == "regime" {
            let codes: Vec<u8> =
                Regime::ALL.iter().map(|regime| regime.code()).chain([NOT_COMPUTED]).collect();
            let meanings: Vec<String> = (Regime::ALL.iter().map(|regime| regime.name()))
                .chain(["not computed"])
                .map(|name| name.replace(' ', "_"))
                .collect();
            about.insert("flag_values".to_owned(), codes.into());
            about.insert("flag_meanings".to_owned(), meanings.join(" ").into());
        }
        let components = |count: usize| -> Vec<&str> {
            Component::all(family.n()).take(count).map(Component::name).collect()
        };
        let names: Option<Vec<&str>> = match field.inner {
            Inner::One => None,
            Inner::Stops => {
                Some(family.label_order().iter().map(|&stop| family.stops()[stop].name.as_str()).collect())
            }
            Inner::Components => Some(components(2 * family.n())),
            Inner::Coordinates => Some(components(family.n())),
            Inner::Multipliers => Some(vec!["real", "imaginary"]),
        };
        if let Some(names) = names {
            about.insert("names".to_owned(), names.into());
        }
        about
    }
}

/// How the bytes of a chunk become those of its place in a shard.
fn of_chunks() -> Result<Vec<Arc<dyn BytesToBytesCodecTraits>>> {
    Ok(vec![Arc::new(GzipCodec::new(COMPRESSION)?), Arc::new(Crc32cCodec::new())])
}

/// The bytes of a shard's index: the place and the length of its chunk, and a checksum.
pub const INDEX: usize = 8 + 8 + 4;

/// The bytes of a shard of one chunk: the chunk's, and the index with its place and checksum.
///
/// The sharding codec of zarrs 0.22 reserves for a chunk what it takes to be the most, which noise exceeds.
pub fn shard_of<T: Element>(values: &[T], shape: &[u64], kind: DataType, fill: FillValue) -> Result<Vec<u8>> {
    let alone = ArrayBuilder::new(shape.to_vec(), shape.to_vec(), kind, fill)
        .bytes_to_bytes_codecs(of_chunks()?)
        .build(Arc::new(MemoryStore::new()), "/")?;
    let options = CodecOptions::default();
    let bytes = T::into_array_bytes(alone.data_type(), values)?;
    let first = vec![0; shape.len()];
    let representation = alone.chunk_array_representation(&first)?;
    let mut shard = alone.codecs().encode(bytes, &representation, &options)?.into_owned();
    let index = [0_u64.to_le_bytes(), (shard.len() as u64).to_le_bytes()].concat();
    shard.extend_from_slice(&Crc32cCodec::new().encode(index.into(), &options)?);
    Ok(shard)
}

/// What stands in a field for cells that were not computed; as a whole number NaN is 0.
pub fn nothing(field: &CellField) -> f64 {
    if field.name == "regime" { NOT_COMPUTED.into() } else { f64::NAN }
}

/// The type of a field in a store, and what stands in it for cells that were not computed.
pub fn kind_and_fill(field: &CellField) -> (DataType, FillValue) {
    let nothing = nothing(field);
    match field.kind() {
        Kind::U8 => (DataType::UInt8, (nothing as u8).into()),
        Kind::U16 => (DataType::UInt16, (nothing as u16).into()),
        Kind::U32 => (DataType::UInt32, (nothing as u32).into()),
        Kind::F32 => (DataType::Float32, (nothing as f32).into()),
        Kind::F64 => (DataType::Float64, nothing.into()),
    }
}

fn coordinates(name: &str, axis: &Axis, store: Arc<FilesystemStore>) -> Result<Array<FilesystemStore>> {
    let count = u64::from(axis.count);
    let description = match axis.quantity {
        Quantity::Parameter(parameter) => parameter.about().about.to_owned(),
        Quantity::Start(component) => format!("{} at the start", component.name()),
        Quantity::Control(setting) => setting.description.to_owned(),
    };
    let about = json!({ "long_name": description, "quantity": axis.quantity.name(), "units": "1" });
    let Value::Object(about) = about else { unreachable!("it is written as an object") };
    Ok(ArrayBuilder::new(vec![count], vec![count], DataType::Float64, f64::NAN)
        .dimension_names(Some([name]))
        .attributes(about)
        .build(store, &format!("/{name}"))?)
}
