using System.Collections.Immutable;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Generation;

/// <summary>
/// The meshes that the engine can make itself: stand-ins for the paper's models 1 and 2 (§5.3, figure 16), whose files are not public,
/// with exactly as many faces, and shapes to test and decorate with.
/// </summary>
public static class MeshGenerators
{
    /// <summary>The most faces that are made: beyond, memory is the limit.</summary>
    public const int MaxFaceCount = 20_000_000;

    /// <summary>All generators.</summary>
    public static ImmutableArray<MeshGenerator> All { get; } =
    [
        new("spaceship-interior", "A corridor of a spaceship with panels, ribs, pipes and consoles; the paper's model 1", 277_654,
        SpaceshipInterior.MinFaceCount, SpaceshipInterior.Create),
        new("tree-stump", "A tree stump with bark, roots and growth rings; the paper's model 2", 237_664, TreeStump.MinFaceCount,
        TreeStump.Create),
        new("terrain", "Mountains and valleys, a height field of noise", 2 * 256 * 256, 2, Terrain.Create),
        new("icosphere", "A sphere of nearly equal triangles", 1280, 20, (_, faces) => RoundShapes.Icosphere(faces)),
        new("torus-knot", "A tube along a knot", 12_288, 200, (_, faces) => RoundShapes.TorusKnot(faces)),
    ];

    /// <summary>The generator of a name; null where there is none.</summary>
    public static MeshGenerator? Find(string name) => All.FirstOrDefault(generator => generator.Name == name);

    /// <summary>Makes a mesh, see <see cref="MeshGenerator.Create"/>.</summary>
    /// <param name="name">One of the names in <see cref="All"/>.</param>
    /// <param name="seed">The same seed gives the same mesh, on one platform bit for bit.</param>
    /// <param name="faces">How many faces it shall have; null for the generator's own number.</param>
    /// <exception cref="ArgumentException">There is no generator of this name.</exception>
    public static Mesh Create(string name, ulong seed = 0, int? faces = null) =>
        (Find(name) ?? throw new ArgumentException($"'{name}' is no generator", nameof(name))).Create(seed, faces);
}
