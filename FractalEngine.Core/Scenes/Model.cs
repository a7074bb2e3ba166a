using System.Collections.Immutable;
using System.Numerics;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Scenes;

/// <summary>The contents of one file, loaded once however many objects show it: a mesh or a fractal.</summary>
public abstract class Model
{
    private protected Model(string path, long fileBytes) => (Path, FileBytes) = (path, fileBytes);

    /// <summary>The full path of the file.</summary>
    public string Path { get; }

    /// <summary>The size of the files it was read from, the base mesh's included.</summary>
    public long FileBytes { get; }

    /// <summary>The mesh that is drawn: once for a mesh, once for each instance of a fractal.</summary>
    public abstract Mesh Mesh { get; }

    /// <summary>
    /// The materials that the mesh's groups name, by their names; those that no file declares are missing. Pictures are named in full and
    /// exist.
    /// </summary>
    public ImmutableDictionary<string, Material> Materials { get; init; } = ImmutableDictionary<string, Material>.Empty;

    /// <summary>1 for a mesh; null for infinitely many.</summary>
    public abstract BigInteger? InstanceCount { get; }

    /// <summary>Instances times faces of the mesh; null for infinitely many.</summary>
    public BigInteger? FaceCount => InstanceCount * Mesh.FaceCount;

    /// <summary>Instances times vertices of the mesh; null for infinitely many.</summary>
    public BigInteger? VertexCount => InstanceCount * Mesh.VertexCount;

    /// <summary>A box that holds the whole model in its own frame.</summary>
    public abstract BoundingBox Bounds { get; }
}

/// <summary>A mesh loaded from a file.</summary>
public sealed class MeshModel(string path, long fileBytes, Mesh mesh) : Model(path, fileBytes)
{
    /// <inheritdoc/>
    public override Mesh Mesh { get; } = mesh;

    /// <inheritdoc/>
    public override BigInteger? InstanceCount => BigInteger.One;

    /// <inheritdoc/>
    public override BoundingBox Bounds => Mesh.Bounds;
}

/// <summary>A fractal loaded from a file.</summary>
public sealed class FractalModel(string path, long fileBytes, Fractal fractal) : Model(path, fileBytes)
{
    /// <summary>The fractal.</summary>
    public Fractal Fractal { get; } = fractal;

    /// <inheritdoc/>
    public override Mesh Mesh => Fractal.BaseMesh;

    /// <inheritdoc/>
    public override BigInteger? InstanceCount => Fractal.InstanceCount;

    /// <inheritdoc/>
    public override BoundingBox Bounds => Fractal.Bounds;
}
