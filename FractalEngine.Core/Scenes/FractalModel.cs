using System.Collections.Immutable;
using System.Globalization;
using System.Numerics;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Rays;

namespace FractalEngine.Core.Scenes;

/// <summary>A model that shows all instances of a fractal.</summary>
/// <param name="fractal">In its own frame, scene units.</param>
public sealed class FractalModel(Fractal fractal) : Model
{
    private readonly Lazy<BigInteger?> _distinctInstanceCount = new(() => DistinctInstances.CountAtMost(fractal));
    private ImmutableArray<Model> _parts;

    /// <summary>The fractal that the model shows.</summary>
    public Fractal Fractal { get; } = fractal ?? throw new ArgumentNullException(nameof(fractal));

    /// <summary>
    /// The materials of each base mesh, in their order; empty where <see cref="Model.Materials"/> are those of all meshes.
    /// </summary>
    public ImmutableArray<ImmutableDictionary<string, Material>> MaterialsByMesh { get; init; } = [];

    /// <inheritdoc/>
    public override ImmutableArray<Model> Parts => !_parts.IsDefault ? _parts : _parts = Fractal.HasSeveralMeshes
        ? [.. Fractal.ByMesh.Select((part, index) => new FractalModel(part)
        {
            SourcePath = SourcePath,
            Materials = MaterialsAt(index),
            Gradient = Gradient,
        })]
        : base.Parts;

    /// <inheritdoc/>
    public override string MeshNameAt(int index) =>
        Path.GetFileName(Fractal.BaseMeshPaths[index]) ?? BaseShapes.NameOf(Fractal.BaseMeshes[index])
        ?? string.Create(CultureInfo.InvariantCulture, $"mesh {index}");

    /// <summary>Returns the materials of a base mesh.</summary>
    /// <param name="index">Index of the mesh.</param>
    public ImmutableDictionary<string, Material> MaterialsAt(int index) =>
        index < MaterialsByMesh.Length ? MaterialsByMesh[index] : Materials;

    /// <summary>How its instances differ in colour where no object says otherwise; null for not at all.</summary>
    public Gradient? Gradient { get; init; }

    /// <summary>Names of the numbers that its file declares, which can be set; empty for a fractal made in code.</summary>
    public ImmutableArray<string> NumberNames { get; init; } = [];

    /// <inheritdoc/>
    public override Mesh Mesh => Fractal.BaseMesh;

    /// <inheritdoc/>
    public override BigInteger? InstanceCount => Fractal.InstanceCount;

    /// <inheritdoc/>
    public override BigInteger? DistinctInstanceCount => _distinctInstanceCount.Value;

    /// <inheritdoc/>
    public override BoundingBox Bounds => Fractal.Bounds;

    /// <inheritdoc/>
    public override Collider CreateCollider(ColliderKind kind = ColliderKind.Exact) => Named(fractal => Collider.For(fractal, kind));

    /// <inheritdoc/>
    public override RayCaster CreateRayCaster() => Named(RayCaster.For);

    private protected override string KindName => "fractal";

    /// <summary>Makes what needs the bounds of the fractal. Where there are none, the message names the model.</summary>
    /// <exception cref="FractalLimitException">The fractal exceeds a limit.</exception>
    internal T Named<T>(Func<Fractal, T> create)
    {
        try
        {
            return create(Fractal);
        }
        catch (FractalLimitException exception)
        {
            throw new FractalLimitException($"{Name}: {exception.Message}", exception);
        }
    }
}
