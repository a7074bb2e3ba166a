using FractalEngine.Core.Bvh.Objects;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Rays;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Rays;

/// <summary>An object of a scene for rays: the caster of its model, and its place in the world.</summary>
/// <param name="index">Index of the object in the scene, from 0.</param>
/// <param name="caster">In the frame of the model, made at the first ray.</param>
/// <param name="objectToWorld">From that frame to world space.</param>
/// <param name="bounds">In world space.</param>
/// <param name="hasLamps">Whether any of its faces shines.</param>
/// <exception cref="SingularMatrixException">The map has no inverse.</exception>
internal sealed class RayInstance(
    int index, Lazy<ShapeRayCaster> caster, AffineMap objectToWorld, BoundingBox bounds, bool hasLamps = false)
    : ObjectBvhLeaf(index, bounds)
{
    private readonly AffineMap _objectToWorld = objectToWorld;
    private readonly SimdAffineMap _worldToObject = new(objectToWorld.Inverse());
    private readonly double _norm = BoundingSphere.OperatorNormBound(objectToWorld.Linear) * (1 + RoundingErrors.Norm);
    private readonly double _inverseNorm =
        BoundingSphere.OperatorNormBound(objectToWorld.Inverse().Linear) * (1 + RoundingErrors.Norm);

    /// <summary>In the frame of the model, made at the first ray.</summary>
    public Lazy<ShapeRayCaster> Caster { get; } = caster;

    /// <summary>The largest absolute coordinate in world space.</summary>
    public double ShapeMagnitude { get; } = bounds.MaxAbsCoordinate();

    /// <summary>Whether any of its faces shines.</summary>
    public bool HasLamps { get; } = hasLamps;

    /// <summary>From the frame of the model to world space.</summary>
    public ref readonly AffineMap ObjectToWorld => ref _objectToWorld;

    /// <summary>Takes a ray to the frame of the model.</summary>
    public LocalRay ToObject(in LocalRay ray) => ray.Transform(in _worldToObject, _inverseNorm, _norm);
}
