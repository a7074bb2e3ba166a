using System.Collections.Immutable;
using System.Runtime.CompilerServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Core.Rays;

/// <summary>Where a ray hits a face.</summary>
/// <param name="Distance">Along the ray, scene units.</param>
/// <param name="Point">In the frame of the ray.</param>
/// <param name="Normal">The unit normal of the face by its winding, in the frame of the ray; not turned towards the ray.</param>
/// <param name="IsFrontFace">True where the ray hits the side that the normal points to.</param>
/// <param name="Barycentrics">Weights of the vertices of the face.</param>
/// <param name="FaceIndex">Index of the face in the mesh, from 0.</param>
[method: MethodImpl(MethodImplOptions.AggressiveInlining)]
public readonly record struct RayHit(
    double Distance, Vector Point, Vector Normal, bool IsFrontFace, Vector Barycentrics, int FaceIndex)
{
    /// <summary>From the frame of the mesh, or of the fractal's base mesh, to that of the ray.</summary>
    public AffineMap InstanceMap { get; init; }

    /// <summary>The mesh with the face: that of the shape, or a base mesh of the fractal.</summary>
    public Mesh Mesh { get; init; } = Mesh.Empty;

    /// <summary>Index of that mesh among the base meshes of the fractal; 0 where there is only one.</summary>
    public int MeshIndex { get; init; }

    /// <summary>
    /// The instance that is hit, as in <see cref="QueryContext.InstancePath"/>. Empty where <c>TryFindNearest</c> has a context: that holds
    /// it then.
    /// </summary>
    public ImmutableArray<int> InstancePath { get; init; } = [];

    /// <summary>Index of the object in its scene, as in <see cref="QueryContext.ObjectIndex"/>; 0 where that holds it.</summary>
    public int ObjectIndex { get; init; }

    /// <summary>Tells whether all numbers of both hits are equal, the paths included.</summary>
    public bool Equals(RayHit other) =>
        Distance.Equals(other.Distance) && Point == other.Point && Normal == other.Normal && IsFrontFace == other.IsFrontFace
        && Barycentrics == other.Barycentrics && FaceIndex == other.FaceIndex && InstanceMap == other.InstanceMap
        && MeshIndex == other.MeshIndex && ObjectIndex == other.ObjectIndex
        && InstancePath.AsSpan().SequenceEqual(other.InstancePath.AsSpan());

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(Distance, Point, FaceIndex, ObjectIndex);

    /// <summary>Interpolates the texture coordinates of the face at the point; null where it has none.</summary>
    /// <param name="mesh">The mesh that was hit, or the base mesh of the fractal.</param>
    public (double U, double V)? TextureCoordinates(Mesh mesh)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        if (mesh.TextureIndices.IsEmpty)
        {
            return null;
        }

        var (u, v) = (0.0, 0.0);
        for (var corner = 0; corner < 3; corner++)
        {
            var index = mesh.TextureIndices[(3 * FaceIndex) + corner];
            if (index < 0)
            {
                return null;
            }

            var weight = corner == 0 ? Barycentrics.X : corner == 1 ? Barycentrics.Y : Barycentrics.Z;
            u += weight * mesh.TextureCoordinates[2 * index];
            v += weight * mesh.TextureCoordinates[(2 * index) + 1];
        }

        return (u, v);
    }
}
