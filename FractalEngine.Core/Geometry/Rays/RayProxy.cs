using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Rays;

/// <summary>A mesh that stands for a larger part of a shape where a ray can't tell them apart.</summary>
/// <param name="map">Stretches the mesh to what it stands for; has an inverse.</param>
internal sealed class RayProxy(AffineMap map)
{
    private readonly SimdAffineMap _map = new(map);
    private readonly SimdAffineMap _inverse = new(map.Inverse());

    /// <summary>Stretches the mesh to what it stands for.</summary>
    public ref readonly SimdAffineMap Map => ref _map;

    /// <summary>Maps what the mesh stands for to the mesh: the inverse of <see cref="Map"/>.</summary>
    public ref readonly SimdAffineMap Inverse => ref _inverse;
}
