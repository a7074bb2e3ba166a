using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Generation;

/// <summary>A generator of meshes of one kind, with any number of faces.</summary>
public sealed class MeshGenerator
{
    private readonly Func<ulong, int, Mesh> _generate;

    internal MeshGenerator(string name, string description, int defaultFaceCount, int minFaceCount, Func<ulong, int, Mesh> generate)
    {
        Name = name;
        Description = description;
        DefaultFaceCount = defaultFaceCount;
        MinFaceCount = minFaceCount;
        _generate = generate;
    }

    internal MeshGenerator(string name, string description, int defaultFaceCount, int minFaceCount, Func<int, Mesh> generate)
        : this(name, description, defaultFaceCount, minFaceCount, (_, faces) => generate(faces)) => HasRandomDetails = false;

    /// <summary>Name of the generator on the command line.</summary>
    public string Name { get; }

    /// <summary>Description of the mesh in a few words.</summary>
    public string Description { get; }

    /// <summary>Exact number of faces, unless stated otherwise.</summary>
    public int DefaultFaceCount { get; }

    /// <summary>Minimum number of faces that make the shape.</summary>
    public int MinFaceCount { get; }

    /// <summary>Whether another seed makes another mesh.</summary>
    public bool HasRandomDetails { get; } = true;

    /// <summary>Generates a mesh with a number of faces.</summary>
    /// <param name="seed">
    /// Seed of random details: the same seed gives the same mesh, on one platform bit for bit.
    /// </param>
    /// <param name="faces">
    /// Number of faces; null for <see cref="DefaultFaceCount"/>. Fewer than <see cref="MinFaceCount"/> give that number. Closed shapes
    /// have an even number, one less than an odd one, and the icosphere takes the closest of 20, 80, 320, …. All others are exact.
    /// </param>
    /// <exception cref="ArgumentOutOfRangeException">More than <see cref="MeshGenerators.MaxFaceCount"/> faces, or less than 1.</exception>
    public Mesh Create(ulong seed = 0, int? faces = null)
    {
        var count = faces ?? DefaultFaceCount;
        ArgumentOutOfRangeException.ThrowIfNegativeOrZero(count, nameof(faces));
        ArgumentOutOfRangeException.ThrowIfGreaterThan(count, MeshGenerators.MaxFaceCount, nameof(faces));
        return _generate(seed, Math.Max(count, MinFaceCount));
    }
}
