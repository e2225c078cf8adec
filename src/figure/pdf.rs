//! Pictures as PDF files.

use std::collections::HashMap;
use std::io;

use pdf_writer::{Content, Finish, Name, Pdf, Rect, Ref, TextStr};
use svg2pdf::ConversionOptions;
use svg2pdf::usvg::{Options, Tree};

/// A PDF file of one page from an SVG document whose text is outlines; 72 pixels are an inch.
///
/// # Errors
/// What the converter reports.
pub fn document(svg: &str, config: &str, command: Option<&str>) -> io::Result<Vec<u8>> {
    let tree = Tree::from_str(svg, &Options::default()).map_err(io::Error::other)?;
    let (chunk, picture) = svg2pdf::to_chunk(&tree, ConversionOptions::default())
        .map_err(|error| io::Error::other(error.to_string()))?;
    let mut next = Ref::new(1);
    let [catalog, pages, page, content, info] = std::array::from_fn(|_| next.bump());
    let mut renumbered = HashMap::new();
    let chunk = chunk.renumber(|old| *renumbered.entry(old).or_insert_with(|| next.bump()));
    let picture = renumbered.get(&picture).copied().unwrap_or(picture);
    let (width, height) = (tree.size().width(), tree.size().height());

    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([page]).count(1);
    let name = Name(b"Picture");
    let mut sheet = pdf.page(page);
    sheet.media_box(Rect::new(0.0, 0.0, width, height)).parent(pages).contents(content);
    sheet.resources().x_objects().pair(name, picture);
    sheet.finish();
    let mut drawn = Content::new();
    drawn.transform([width, 0.0, 0.0, height, 0.0, 0.0]).x_object(name);
    pdf.stream(content, &drawn.finish());
    pdf.extend(&chunk);
    let mut about = pdf.document_info(info);
    about.creator(TextStr(concat!("impact-atlas ", env!("CARGO_PKG_VERSION")))).subject(TextStr(config));
    if let Some(command) = command {
        about.keywords(TextStr(command));
    }
    about.finish();
    Ok(pdf.finish())
}
