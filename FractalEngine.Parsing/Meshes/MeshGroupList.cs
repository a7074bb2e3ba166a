using System.Collections.Immutable;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Parsing.Meshes;

/// <summary>Names and materials that a mesh file gives to runs of faces.</summary>
internal sealed class MeshGroupList
{
    private readonly List<MeshGroup> _groups = [];
    private (string Object, string Group, string Material, int Smoothing) _state = ("", "", "", 0);
    private int _firstFace;

    /// <summary>Gives the object's name to the faces from an index on.</summary>
    public void ChangeObject(string name, int face) => Change(_state with { Object = name }, face);

    /// <summary>Gives the group's name to the faces from an index on.</summary>
    public void ChangeGroup(string name, int face) => Change(_state with { Group = name }, face);

    /// <summary>Gives the name of a material to the faces from an index on.</summary>
    public void ChangeMaterial(string name, int face) => Change(_state with { Material = name }, face);

    /// <summary>Gives the smoothing group to the faces from an index on.</summary>
    public void ChangeSmoothing(int group, int face) => Change(_state with { Smoothing = group }, face);

    /// <summary>Returns the groups of all faces; none for a file that names none.</summary>
    public ImmutableArray<MeshGroup> Complete(int faceCount)
    {
        End(faceCount);
        return _groups is [{ ObjectName: "", GroupName: "", Material: "", SmoothingGroup: 0 }] ? [] : [.. _groups];
    }

    private void Change((string Object, string Group, string Material, int Smoothing) state, int face)
    {
        if (state != _state)
        {
            End(face);
            _state = state;
        }
    }

    private void End(int face)
    {
        if (face > _firstFace)
        {
            _groups.Add(new(_firstFace, face - _firstFace, _state.Object, _state.Group, _state.Material, _state.Smoothing));
            _firstFace = face;
        }
    }
}
