using FractalEngine.Core.Geometry;
namespace FractalEngine.Core.Generation;

/// <summary>A mesh that is made by a program.</summary>
public sealed class MeshGenerator
{
    private readonly Func<ulong, int, Mesh> _generate;

    internal MeshGenerator(string name, string description, int defaultFaceCount, int minFaceCount, Func<ulong, int, Mesh> generate) =>
        (Name, Description, DefaultFaceCount, MinFaceCount, _generate) = (name, description, defaultFaceCount, minFaceCount, generate);

    /// <summary>What it is asked for by.</summary>
    public string Name { get; }

    /// <summary>What it looks like, in a few words.</summary>
    public string Description { get; }

    /// <summary>How many faces it has when nothing else is asked for, exactly.</summary>
    public int DefaultFaceCount { get; }

    /// <summary>The fewest faces that make its shape.</summary>
    public int MinFaceCount { get; }

    /// <summary>Makes the mesh.</summary>
    /// <param name="seed">
    /// The same seed gives the same mesh, on one platform bit for bit; shapes without chance do not depend on it.
    /// </param>
    /// <param name="faces">
    /// How many faces it shall have; null for <see cref="DefaultFaceCount"/>. Fewer than <see cref="MinFaceCount"/> give
    /// that number. Exact for all but closed shapes, which have an even number (one less where an odd one is asked for), and the
    /// icosphere, which takes the nearest of 20, 80, 320, ….
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
