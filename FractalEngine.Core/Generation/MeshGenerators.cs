using System.Collections.Immutable;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Generation;

/// <summary>
/// All mesh generators of the engine.
/// </summary>
/// <remarks>
/// Two of them replace the paper's models 1 and 2 (§5.3, figure 16), whose files are not public, with exactly as many faces. The others
/// are shapes for tests and decoration.
/// </remarks>
public static class MeshGenerators
{
    /// <summary>Maximum number of faces of a generated mesh; beyond it memory is the limit.</summary>
    public const int MaxFaceCount = 20_000_000;

    /// <summary>All generators, each with a name of its own.</summary>
    public static ImmutableArray<MeshGenerator> All { get; } =
    [
        new(
            "spaceship-interior", "A corridor of a spaceship with panels, ribs, pipes and consoles; the paper's model 1",
            277_654, SpaceshipInterior.MinFaceCount, SpaceshipInterior.Create),
        new(
            "tree-stump", "A tree stump with bark, roots and growth rings; the paper's model 2",
            237_664, TreeStump.MinFaceCount, TreeStump.Create),
        new("terrain", "Mountains and valleys, a height field of noise", 2 * 256 * 256, 2, Terrain.Create),
        new("icosphere", "A sphere of nearly equal triangles", 1280, 20, RoundShapes.Icosphere),
        new("torus-knot", "A tube along a knot", 12_288, 200, RoundShapes.TorusKnot),
    ];

    /// <summary>Finds the generator of a name.</summary>
    /// <returns>Null where there is none.</returns>
    public static MeshGenerator? Find(string name) => All.FirstOrDefault(generator => generator.Name == name);

    /// <summary>Generates a mesh by the name of its generator, see <see cref="MeshGenerator.Create"/>.</summary>
    /// <param name="name">Name of one of the generators in <see cref="All"/>.</param>
    /// <param name="seed">Seed of random details: the same seed gives the same mesh, on one platform bit for bit.</param>
    /// <param name="faces">Number of faces; null for the default of the generator.</param>
    /// <exception cref="ArgumentException">There is no generator of this name.</exception>
    public static Mesh Create(string name, ulong seed = 0, int? faces = null) =>
        (Find(name) ?? throw new ArgumentException($"'{name}' is no generator", nameof(name))).Create(seed, faces);
}
