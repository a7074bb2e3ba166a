using System.Collections.Immutable;
using System.Numerics;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Rays;

namespace FractalEngine.Core.Scenes;

/// <summary>A model that shows all instances of a fractal.</summary>
/// <param name="fractal">In its own frame, scene units.</param>
public sealed class FractalModel(Fractal fractal) : Model
{
    /// <summary>The fractal that the model shows.</summary>
    public Fractal Fractal { get; } = fractal ?? throw new ArgumentNullException(nameof(fractal));

    /// <summary>Names of the numbers that its file declares, which can be set; empty for a fractal made in code.</summary>
    public ImmutableArray<string> NumberNames { get; init; } = [];

    /// <inheritdoc/>
    public override Mesh Mesh => Fractal.BaseMesh;

    /// <inheritdoc/>
    public override BigInteger? InstanceCount => Fractal.InstanceCount;

    /// <inheritdoc/>
    public override BoundingBox Bounds => Fractal.Bounds;

    /// <inheritdoc/>
    public override Collider CreateCollider(ColliderKind kind = ColliderKind.Exact) => Collider.For(Fractal, kind);

    /// <inheritdoc/>
    public override RayCaster CreateRayCaster() => RayCaster.For(Fractal);

    private protected override string KindName => "fractal";
}
