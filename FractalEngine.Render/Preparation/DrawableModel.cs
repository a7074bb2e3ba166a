using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility;

namespace FractalEngine.Render.Preparation;

/// <summary>A model as the GPU takes it: plain arrays, no GL. Shared by all objects that show the model.</summary>
public sealed class DrawableModel
{
    /// <summary>Floats of one vertex: position, then normal.</summary>
    public const int FloatsPerVertex = 6;

    /// <summary>Floats of one instance: the three rows of a 3×4 map.</summary>
    public const int FloatsPerInstance = 12;

    internal DrawableModel(string name, Vector origin, BoundingBox bounds, float[] vertices, uint[] indices, float[] instances) =>
        (Name, Origin, Bounds, Vertices, Indices, Instances) = (name, origin, bounds, vertices, indices, instances);

    /// <summary>The file's name, for labels.</summary>
    public string Name { get; }

    /// <summary>
    /// The point of the model's frame that the floats are relative to: the model's middle, so that they keep their precision for
    /// models far from their own origin.
    /// </summary>
    public Vector Origin { get; }

    /// <summary>Of the model, in its own frame.</summary>
    public BoundingBox Bounds { get; }

    /// <summary>Position and unit normal, [vertices × 6].</summary>
    public ReadOnlyMemory<float> Vertices { get; }

    /// <summary>Vertex numbers, [triangles × 3].</summary>
    public ReadOnlyMemory<uint> Indices { get; }

    /// <summary>(u, v) of each vertex, v upwards, [vertices × 2]; empty where no material has a picture.</summary>
    public ReadOnlyMemory<float> TextureCoordinates { get; init; }

    /// <summary>Faces of the mesh that are not among the triangles, since they have no area.</summary>
    public int DegenerateTriangleCount { get; init; }

    /// <summary>Together they cover all indices.</summary>
    public ImmutableArray<DrawableBatch> Batches { get; init; } = [];

    /// <summary>Whether any part is drawn after the opaque ones, and blended.</summary>
    public bool HasTransparentBatches => Batches.Any(static batch => batch.IsTransparent);

    /// <summary>Maps from the mesh to the model, by rows, [<see cref="InstanceCount"/> × 12].</summary>
    public ReadOnlyMemory<float> Instances { get; }

    /// <summary>
    /// 1 where the model consists of solids wound outwards and −1 where inwards, so that from outside only one side of their faces is
    /// ever seen; 0 where that is not known.
    /// </summary>
    internal int WindingSign { get; init; }

    /// <summary>
    /// The levels from which the instances are chosen for each picture; null where all instances are there from the beginning.
    /// </summary>
    public LodHierarchy? LodHierarchy { get; init; }

    /// <summary>The point of the mesh's frame that the vertices are relative to.</summary>
    internal Vector MeshOrigin { get; init; }

    /// <summary>As <see cref="WindingSign"/>, of the mesh alone.</summary>
    internal int MeshWindingSign { get; init; }

    /// <summary>True for a box that stands for a model which is not prepared yet.</summary>
    public bool IsPlaceholder { get; init; }

    /// <summary>How many copies of the mesh one draw call makes; none where that depends on the picture.</summary>
    public int InstanceCount => Instances.Length / FloatsPerInstance;

    /// <summary>Triangles of all instances together.</summary>
    public long TriangleCount => (long)InstanceCount * (Indices.Length / 3);
}
