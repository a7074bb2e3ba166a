using FractalEngine.Core.Fractals.Descriptions;

namespace FractalEngine.Parsing.Fdo;

/// <summary>The parts of a fractal file, and the files and shapes that they begin with.</summary>
/// <param name="keepsSums">Whether sums and sets stay as they are written, see <see cref="FractalPartList"/>.</param>
internal sealed class DeclaredBases(bool keepsSums)
{
    private readonly Dictionary<(string Name, string? File, string? Material), int> _numbers = [];

    /// <summary>The parts of all objects.</summary>
    public FractalPartList Parts { get; } = new(keepsSums);

    /// <summary>The files and shapes, in the order in which they were named.</summary>
    public List<BaseReference> References { get; } = [];

    /// <summary>Adds the object that a file or shape is, without steps.</summary>
    /// <param name="name">Name of the file, as written, or of the shape.</param>
    /// <param name="offset">Offset of the name in the text.</param>
    /// <param name="material">The material of all faces; null for none but that of the file.</param>
    public DeclaredObject Add(string name, int offset, MaterialReference? material = null)
    {
        // By chance, one file of one material is one object wherever it is named.
        var key = (name, material?.File, material?.Name);
        if (!keepsSums || _numbers.TryAdd(key, References.Count))
        {
            References.Add(new(name, offset) { Material = material });
        }

        return new(Parts.AddMesh(keepsSums ? _numbers[key] : References.Count - 1), DeclaredSteps.None);
    }

    /// <summary>Returns the part that an object with all its steps is.</summary>
    public int PartOf(DeclaredObject value) => Parts.AddSteps(value.Part, value.Steps.Take(value.Steps.Count));

    /// <summary>Tells whether an object is repeated without end, or made of such ones.</summary>
    public bool IsInfinite(DeclaredObject value) => value.Steps.LevelCount is null || Parts.IsInfinite(value.Part);
}
