using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Render.Drawables;

/// <summary>A model as plain arrays for the GPU, without any GL. All objects that show the model share it.</summary>
public sealed class DrawableModel
{
    /// <summary>Number of floats a vertex: position, then normal.</summary>
    public const int FloatsPerVertex = 6;

    /// <summary>Number of floats an instance: the three rows of a 3×4 map.</summary>
    public const int FloatsPerInstance = 12;

    internal DrawableModel(string name, Vector origin, BoundingBox bounds, float[] vertices, uint[] indices, float[] instances)
    {
        Name = name;
        Origin = origin;
        Bounds = bounds;
        Vertices = vertices;
        Indices = indices;
        Instances = instances;
    }

    /// <summary>Name of the file, for messages.</summary>
    public string Name { get; }

    /// <summary>
    /// Centre of the model in its own frame, which instances are relative to. Floats then stay precise in models far from their origin.
    /// </summary>
    public Vector Origin { get; }

    /// <summary>Bounds of the model in its own frame.</summary>
    public BoundingBox Bounds { get; }

    /// <summary>Position and unit normal of each vertex, [vertices × 6].</summary>
    public ReadOnlyMemory<float> Vertices { get; }

    /// <summary>Vertex indices of the triangles, [triangles × 3].</summary>
    public ReadOnlyMemory<uint> Indices { get; }

    /// <summary>(u, v) of each vertex with v upwards, [vertices × 2]; empty where no material has a texture.</summary>
    public ReadOnlyMemory<float> TextureCoordinates { get; init; }

    /// <summary>Colour of each vertex, linear light, [vertices × 3]; empty where the mesh has none.</summary>
    public ReadOnlyMemory<float> Colours { get; init; }

    /// <summary>Number of the mesh's triangles that were removed since they have no area.</summary>
    public int DegenerateTriangleCount { get; init; }

    /// <summary>Batches by material, which together cover all indices.</summary>
    public ImmutableArray<DrawableBatch> Batches { get; init; } = [];

    /// <summary>True where any batch is transparent, and drawn after the opaque ones.</summary>
    public bool HasTransparentBatches => Batches.Any(static batch => batch.IsTransparent);

    /// <summary>True where any batch casts a shadow: transparent ones cast none.</summary>
    internal bool HasCasterBatches => Batches.Any(static batch => !batch.IsTransparent);

    /// <summary>True where what is behind shows through any batch, or through holes in it.</summary>
    public bool IsSeeThrough => !Batches.All(static batch => batch.IsSolid);

    /// <summary>Maps from the mesh to the model by rows, [<see cref="InstanceCount"/> × 12].</summary>
    public ReadOnlyMemory<float> Instances { get; }

    /// <summary>What maps mix into the colours of instances, a <see cref="Tint"/> for each, [instances × 4]; else empty.</summary>
    public ReadOnlyMemory<float> InstanceTints { get; init; }

    /// <summary>
    /// 1 where the model consists of solids wound outwards and −1 where inwards, so that from outside only one face of their triangles is
    /// visible; 0 where that is not known.
    /// </summary>
    internal int WindingSign { get; init; }

    /// <summary>
    /// As <see cref="WindingSign"/>, but found out for larger meshes too, when a section plane asks for it first: for filling them.
    /// </summary>
    internal Lazy<int> SolidSign { get; init; } = new(0);

    /// <summary>Hierarchy that visible instances are selected from for each frame; null where all instances are drawn.</summary>
    public LodHierarchy? LodHierarchy { get; init; }

    /// <summary>Whether instances come with the sides that are never seen, which normals of vertices tell apart.</summary>
    internal bool HasCoveredSides { get; init; }

    /// <summary>Whether no part of a fractal hides another one's sky, so that nothing needs to be baked.</summary>
    internal bool HasOpenSky { get; init; }

    /// <summary>Whether the model lies in a plane: it hides light from none of its own parts.</summary>
    internal bool IsFlat { get; init; }

    /// <summary>Whether the model is a convex solid: from outside, it hides light from none of what is seen of it.</summary>
    internal bool IsConvex { get; init; }

    /// <summary>Point of the mesh's frame that vertices are relative to.</summary>
    internal Vector MeshOrigin { get; init; }

    /// <summary>Winding sign of the mesh alone, as <see cref="WindingSign"/>.</summary>
    internal int MeshWindingSign { get; init; }

    /// <summary>True for the box that is shown instead of a model that is not prepared yet.</summary>
    public bool IsPlaceholder { get; init; }

    /// <summary>Number of instances that one call draws; 0 where it depends on the frame.</summary>
    public int InstanceCount => Instances.Length / FloatsPerInstance;

    /// <summary>Number of triangles of all instances together.</summary>
    public long TriangleCount => (long)InstanceCount * (Indices.Length / 3);
}
