//! What a person looks at: pictures of every stage, the report as data, and the summary in a
//! terminal.

mod canvas;
pub mod colours;
pub mod comparison;
pub mod coupling;
mod coverage;
pub mod document;
pub mod explain;
pub mod figures;
mod gaps;
mod ink;
pub mod inspection;
pub mod legend;
mod lettering;
pub mod mask;
pub mod methods;
pub mod neighbours;
pub mod page;
mod palette;
pub mod paper;
pub mod picture;
pub mod png;
pub mod prediction;
mod quantity;
pub mod relief;
pub mod stages;
mod summary;
pub mod svg;
pub mod terminal;
pub mod thinning;
pub mod translucent;
pub mod verdict;
mod xml;

pub use canvas::Canvas;
pub use document::Document;
pub use inspection::Inspection;
pub use lettering::Lettering;
pub use palette::{Rgb, tints, vivid};
pub use summary::warnings;
pub use verdict::Verdict;
