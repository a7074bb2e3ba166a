using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.Tools;

/// <summary>
/// The normals of faces as lines from their middles: those of the selected instance, or those of all meshes where nothing is selected.
/// They are computed again only when something has changed.
/// </summary>
internal sealed class NormalLines
{
    /// <summary>Maximum number of normals; those of further faces are left out.</summary>
    public const int MaxNormals = 5000;

    // Length of a normal by the length of the longest edge of its face.
    private const double LengthRatio = 0.4;

    private static readonly Colour LineColour = new(0.3, 0.9, 1);

    private (LoadedScene Scene, Selection? Selected) _key;
    private List<LineSegment> _lines = [];

    /// <summary>Whether normals are shown.</summary>
    public bool IsOn { get; set; }

    /// <summary>Adds the lines, in world space.</summary>
    /// <param name="scene">The scene with its bodies where they are.</param>
    /// <param name="selected">What is selected; null for nothing.</param>
    /// <param name="lines">The list that is added to.</param>
    public void AddTo(LoadedScene scene, Selection? selected, List<LineSegment> lines)
    {
        if (!IsOn)
        {
            return;
        }

        if (!ReferenceEquals(_key.Scene, scene) || !ReferenceEquals(_key.Selected, selected))
        {
            _key = (scene, selected);
            _lines = [];
            if (selected is not null)
            {
                var placed = selected.Object;
                if ((selected.Hit?.InstanceMap ?? (placed.Model is MeshModel ? placed.ObjectToWorld : null)) is { } map)
                {
                    AddMesh(placed.Model.Mesh, map);
                }
            }
            else
            {
                foreach (var placed in scene.Objects.Where(static placed => placed.Model is MeshModel))
                {
                    AddMesh(placed.Model.Mesh, placed.ObjectToWorld);
                }
            }
        }

        lines.AddRange(_lines);
    }

    private void AddMesh(Mesh mesh, AffineMap map)
    {
        for (var face = 0; face < mesh.FaceCount && _lines.Count < MaxNormals; face++)
        {
            var (a, b, c) = mesh.Face(face);
            var (first, second) = (map.Linear * (b - a), map.Linear * (c - a));
            var normal = Vector.Cross(first, second);
            var length = normal.Length();
            if (length > 0 && double.IsFinite(length))
            {
                var middle = (1.0 / 3) * ((map * a) + (map * b) + (map * c));
                var edge = Math.Max(first.Length(), second.Length());
                _lines.Add(new(middle, middle + (LengthRatio * edge / length * normal), LineColour));
            }
        }
    }
}
