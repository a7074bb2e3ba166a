using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Mtl;

namespace FractalEngine.Parsing.Exports;

/// <summary>A mesh of an object of a scene, with all places where it stands.</summary>
/// <param name="Placed">The object, with the part of its model that shows the mesh.</param>
/// <param name="ObjectIndex">Index of the object in the scene.</param>
/// <param name="MeshIndex">Index of the mesh among those of the object's model.</param>
/// <param name="Count">Number of instances.</param>
/// <param name="Instances">The instances, which may be enumerated again; their maps lead from the mesh to the file.</param>
public sealed record ExportedPart(PlacedModel Placed, int ObjectIndex, int MeshIndex, long Count, IEnumerable<MeshInstance> Instances)
{
    /// <summary>The mesh that stands at all places.</summary>
    public Mesh Mesh => Placed.Model.Mesh;

    /// <summary>Whether something says a colour of the mesh, so that it is more than one of those that tell objects apart.</summary>
    public bool HasColour =>
        Placed.HasTints || Placed.Declaration.Colour is not null || !Placed.Model.Materials.IsEmpty || !Mesh.Colours.IsEmpty;

    /// <summary>Index by which objects without a colour are told apart, see <see cref="ObjectPalette"/>.</summary>
    public int PaletteIndex => ObjectIndex + MeshIndex;

    /// <summary>The name of the object: its own, or that of its file.</summary>
    public string ObjectName => Placed.Declaration.Name ?? Path.GetFileNameWithoutExtension(Placed.Declaration.DisplayName);

    /// <summary>The groups of the mesh, or one for all faces where groups that were made in code leave faces out.</summary>
    public IReadOnlyList<MeshGroup> Groups => Mesh.Groups.Sum(static group => group.FaceCount) == Mesh.FaceCount
        ? Mesh.Groups : [new(0, Mesh.FaceCount, "", "", "", 0)];

    /// <summary>The name of the material of faces of an instance, which is added where maps make a new one; empty for none.</summary>
    /// <param name="materials">Those of the scene; null where they are not written.</param>
    /// <param name="group">Name of the material in the mesh; empty for none.</param>
    /// <param name="tint">What maps mix into the colour of the instance.</param>
    public string MaterialOf(SceneMaterials? materials, string group, Tint tint) => (Placed.HasTints
        ? materials?.NameOf(Placed, PaletteIndex, group, tint)
        : materials?.NameOf(Placed, group)) ?? "";

    /// <summary>The colour of faces of an instance, without textures and gradients.</summary>
    /// <param name="group">Name of the material in the mesh; empty for none.</param>
    /// <param name="tint">What maps mix into the colour of the instance.</param>
    public Colour ColourOf(string group, Tint tint) => SceneMaterials.ColourOf(Placed, PaletteIndex, group, tint);

    /// <summary>Rounds a colour to a byte for each component, sRGB.</summary>
    public static (byte Red, byte Green, byte Blue) ToBytes(Colour colour)
    {
        return (ToByte(colour.Red), ToByte(colour.Green), ToByte(colour.Blue));

        static byte ToByte(double component) => (byte)Math.Round(byte.MaxValue * Math.Clamp(component, 0, 1));
    }
}
