namespace FractalEngine.Parsing.Meshes;

/// <summary>Numbers of elements in a mesh file, or in a part of it.</summary>
/// <param name="Positions">Number of vertices.</param>
/// <param name="TextureCoordinates">Number of texture coordinates.</param>
/// <param name="Normals">Number of normals.</param>
/// <param name="Faces">Number of triangles.</param>
internal readonly record struct ElementCounts(int Positions, int TextureCoordinates, int Normals, int Faces)
{
    /// <summary>Adds the numbers of two parts.</summary>
    public static ElementCounts operator +(ElementCounts part1, ElementCounts part2) => new(
        part1.Positions + part2.Positions, part1.TextureCoordinates + part2.TextureCoordinates, part1.Normals + part2.Normals,
        part1.Faces + part2.Faces);

    /// <summary>Returns whether no number is larger than the one of other counts.</summary>
    public bool AreWithin(ElementCounts other) =>
        Positions <= other.Positions && TextureCoordinates <= other.TextureCoordinates && Normals <= other.Normals;
}
