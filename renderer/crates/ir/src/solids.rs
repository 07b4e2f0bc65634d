//! Solids: their surfaces, with the textures on them.

use m3d_kernel::scene::Solid;
use m3d_kernel::shade::highlight::Gloss;
use m3d_kernel::shade::illumination::Surface;
use m3d_kernel::texture::heights::Heights;

use crate::ir::Ir;
use crate::refusal::Result;
use crate::tables::Owned;
use crate::textures::textures;

pub fn solids(ir: &Ir) -> Result<Vec<Solid>> {
    let object_inverse = ir.table("solids").matrices("inverse")?;
    let (textures, heights) = (textures(ir)?, heights(ir));
    let mut owned = Owned::new("textures", textures.len());
    let table = ir.table("surfaces");
    let color = table.vectors("color")?;
    let numbers = |column| table.numbers(column);
    let (ambient, diffuse, specular) = (numbers("ambient")?, numbers("diffuse")?, numbers("specular")?);
    let (refindex, rough, hard) = (numbers("refindex")?, numbers("rough")?, numbers("hard")?);
    let (metallic, fresnel, fuzz) = (numbers("metallic")?, numbers("fresnel")?, numbers("fuzz")?);
    // Infinite where ROUGH is 0.
    let beckmann = table.plain::<f64>("beckmann")?;
    let (first, count) = (table.plain("first_texture")?, table.plain("texture_count")?);
    (0..object_inverse.len())
        .map(|i| {
            let used = owned.take(table.entry(first, i)?, table.entry(count, i)?)?;
            Ok(Solid {
                surface: Surface {
                    color: table.entry(&color, i)?,
                    ambient: table.entry(ambient, i)?,
                    diffuse: table.entry(diffuse, i)?,
                    specular: table.entry(specular, i)?,
                    hard: table.entry(hard, i)?,
                    fuzz: table.entry(fuzz, i)?,
                    gloss: Gloss {
                        refindex: table.entry(refindex, i)?,
                        rough: table.entry(rough, i)?,
                        metallic: table.entry(metallic, i)?,
                        fresnel: table.entry(fresnel, i)?,
                        beckmann: table.entry(beckmann, i)?,
                    },
                },
                textures: textures[used]
                    .iter()
                    .map(|texture| texture.on(object_inverse[i], heights))
                    .collect::<Result<_>>()?,
            })
        })
        .collect()
}

/// The heights of the scene's extent, if it has any.
fn heights(ir: &Ir) -> Option<Heights> {
    let extent = ir.globals.extent.as_ref()?;
    Some(Heights { low: extent.minimum[2], high: extent.maximum[2] })
}
