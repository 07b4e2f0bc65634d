//! The shapes a ray can meet, a file each: with its box, its test against a straight ray, its cut by the vertical plane
//! of a curved one, its normals and its u and v. Thesis 3.3 and 4.3.

pub mod affine;
pub mod facet;
pub mod geometry;
pub mod plane;
pub mod rectangle;
pub mod sphere;

use glam::DVec3;

use crate::optics::crossing::{Crossing, Range};
use crate::optics::path::Path;
use crate::optics::radial_plane::RadialPlane;
use crate::ray::Ray;
use geometry::{Bounds, Geometry};
use plane::Plane;
use rectangle::Rectangle;
use sphere::Sphere;

/// Makes the enum of shapes, each question to which is passed on to the kind's own file.
macro_rules! closed_set {
    ($($kind:ident),*) => {
        /// The closed set of shapes that are no facets.
        #[derive(Clone, Copy, Debug)]
        pub enum Shape {
            $($kind($kind),)*
        }

        /// In the order in which they count as nearer where a ray meets two at the same distance.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
        pub enum ShapeKind {
            $($kind,)*
        }

        impl Shape {
            pub fn kind(&self) -> ShapeKind {
                match self {
                    $(Self::$kind(_) => ShapeKind::$kind,)*
                }
            }
        }

        impl Geometry for Shape {
            fn bounds(&self) -> Bounds {
                match self {
                    $(Self::$kind(shape) => shape.bounds(),)*
                }
            }

            #[inline(always)]
            fn meet(&self, ray: &Ray, own: bool) -> Option<f64> {
                match self {
                    $(Self::$kind(shape) => shape.meet(ray, own),)*
                }
            }

            #[inline(always)]
            fn meet_curve(&self, plane: &RadialPlane, path: &mut Path, range: &mut Range) -> Option<Crossing> {
                match self {
                    $(Self::$kind(shape) => shape.meet_curve(plane, path, range),)*
                }
            }

            fn normal(&self, point: DVec3) -> DVec3 {
                match self {
                    $(Self::$kind(shape) => shape.normal(point),)*
                }
            }

            fn shading_normal(&self, point: DVec3) -> Option<DVec3> {
                match self {
                    $(Self::$kind(shape) => shape.shading_normal(point),)*
                }
            }

            fn uv(&self, point: DVec3) -> Option<(f64, f64)> {
                match self {
                    $(Self::$kind(shape) => shape.uv(point),)*
                }
            }
        }

        $(impl From<$kind> for Shape {
            fn from(shape: $kind) -> Self {
                Self::$kind(shape)
            }
        })*
    };
}

closed_set!(Sphere, Rectangle, Plane);
