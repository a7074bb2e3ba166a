using System.Numerics;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Rays;

namespace FractalEngine.Core.Scenes;

/// <summary>A model that shows one mesh.</summary>
/// <param name="mesh">In its own frame, scene units.</param>
public sealed class MeshModel(Mesh mesh) : Model
{
    /// <inheritdoc/>
    public override Mesh Mesh { get; } = mesh ?? throw new ArgumentNullException(nameof(mesh));

    /// <inheritdoc/>
    public override BigInteger? InstanceCount => BigInteger.One;

    /// <inheritdoc/>
    public override BoundingBox Bounds => Mesh.Bounds;

    /// <inheritdoc/>
    public override Collider CreateCollider(ColliderKind kind = ColliderKind.Exact) => Collider.For(Mesh, kind);

    /// <inheritdoc/>
    public override RayCaster CreateRayCaster() => RayCaster.For(Mesh);

    private protected override string KindName => "mesh";
}
