using System.Collections.Immutable;
using System.Numerics;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Rays;

namespace FractalEngine.Core.Scenes;

/// <summary>What an object of a scene shows: a mesh or a fractal. Any number of objects can share one model.</summary>
public abstract class Model
{
    private ImmutableArray<Model> _onlyPart;

    private protected Model()
    {
    }

    /// <summary>The full path of the file that the model was loaded from; null for a model made in code.</summary>
    public string? SourcePath { get; init; }

    /// <summary>Size in bytes of the files that the model was loaded from, the base mesh's included; 0 for a model made in code.</summary>
    public long FileBytes { get; init; }

    /// <summary>
    /// What a scene has around the model where it is shown alone, as its file says: camera, lights, handedness; without objects. Null for
    /// what the program chooses.
    /// </summary>
    public Scene? Surroundings { get; init; }

    /// <summary>The name for messages and labels: that of the file, or the kind of model where there is no file.</summary>
    public string Name => SourcePath is { } path ? Path.GetFileName(path) : KindName;

    /// <summary>The mesh that is drawn: once for a mesh, once for each instance of a fractal.</summary>
    /// <exception cref="InvalidOperationException">The instances of a fractal show several meshes: see <see cref="Parts"/>.</exception>
    public abstract Mesh Mesh { get; }

    /// <summary>
    /// The model by its meshes, each with its instances, and its materials: those of a fractal with several base meshes, in their order.
    /// Any other model is its only part.
    /// </summary>
    public virtual ImmutableArray<Model> Parts => !_onlyPart.IsDefault ? _onlyPart : _onlyPart = [this];

    /// <summary>
    /// The materials that the groups of the mesh name, by their names; those that no file declares are missing. Paths of textures are
    /// full and exist.
    /// </summary>
    public ImmutableDictionary<string, Material> Materials { get; init; } = ImmutableDictionary<string, Material>.Empty;

    /// <summary>Number of instances of the mesh: 1 for a mesh, null for infinitely many.</summary>
    public abstract BigInteger? InstanceCount { get; }

    /// <summary>Instances times faces of their meshes; null for infinitely many.</summary>
    public BigInteger? FaceCount => Sum(static mesh => mesh.FaceCount);

    /// <summary>Instances times vertices of their meshes; null for infinitely many.</summary>
    public BigInteger? VertexCount => Sum(static mesh => mesh.VertexCount);

    /// <summary>
    /// Number of distinct instances at most, see <see cref="DistinctInstances.CountAtMost"/>: what the identity in sets repeats counts
    /// once. Computed by the first who asks.
    /// </summary>
    public virtual BigInteger? DistinctInstanceCount => InstanceCount;

    /// <summary>Number of faces of distinct instances at most; null for infinitely many.</summary>
    public BigInteger? DistinctFaceCount => Parts.Aggregate(
        (BigInteger?)BigInteger.Zero, static (sum, part) => sum + (part.DistinctInstanceCount * part.Mesh.FaceCount));

    /// <summary>A box that holds the whole model in its own frame.</summary>
    public abstract BoundingBox Bounds { get; }

    private protected abstract string KindName { get; }

    /// <summary>The name of one of its meshes, for messages: that of a file or a shape, or the model's own.</summary>
    /// <param name="index">Index among the base meshes of a fractal; 0 for a mesh.</param>
    public virtual string MeshNameAt(int index) => Name;

    private BigInteger? Sum(Func<Mesh, long> valueOf) => Parts.Aggregate(
        (BigInteger?)BigInteger.Zero, (sum, part) => sum + (part.InstanceCount * valueOf(part.Mesh)));

    /// <summary>Makes the model that shows a mesh.</summary>
    /// <param name="mesh">In its own frame, scene units.</param>
    public static Model Of(Mesh mesh) => new MeshModel(mesh);

    /// <summary>Makes the model that shows a fractal.</summary>
    /// <param name="fractal">In its own frame, scene units.</param>
    public static Model Of(Fractal fractal) => new FractalModel(fractal);

    /// <summary>Builds the collider of the model in its own frame.</summary>
    /// <param name="kind">How to search; exact unless stated.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such kind.</exception>
    /// <exception cref="ColliderMismatchException">The kind does not fit; the message says which kinds do.</exception>
    /// <exception cref="FractalLimitException">The fractal is too large for this kind, or grows beyond a double.</exception>
    public abstract Collider CreateCollider(ColliderKind kind = ColliderKind.Exact);

    /// <summary>Makes the caster of rays at the model in its own frame.</summary>
    /// <exception cref="FractalLimitException">A fractal can't be prepared, see <see cref="RayCaster.For(Fractal)"/>.</exception>
    /// <exception cref="SingularMatrixException">A map of the fractal has no inverse.</exception>
    public abstract RayCaster CreateRayCaster();
}
