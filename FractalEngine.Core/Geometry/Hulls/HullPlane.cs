using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Hulls;

/// <summary>A plane that bounds a convex hull: normal · point ≤ offset for all points of the hull.</summary>
/// <param name="Normal">Outward normal of length 1.</param>
/// <param name="Offset">Signed distance of the plane from the origin, along the normal.</param>
/// <param name="DoubledArea">Twice the area of the hull's facets in the plane.</param>
internal readonly record struct HullPlane(Vector Normal, double Offset, double DoubledArea);
