using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.Tools;

/// <summary>
/// The bounding boxes of all sub-fractals at one level, as lines. They are computed again only when something has changed.
/// </summary>
internal sealed class BoxesOfLevel
{
    /// <summary>Maximum number of boxes; those of further sub-fractals are left out.</summary>
    public const int MaxBoxes = 1000;

    private static readonly Colour LineColour = new(0.55, 0.75, 1);

    private (LoadedScene Scene, int Level) _key;
    private List<LineSegment> _lines = [];

    /// <summary>The level whose boxes are shown: 0 for whole objects, −1 for none.</summary>
    public int Level { get; set; } = -1;

    /// <summary>Adds the lines of the boxes in world space.</summary>
    /// <param name="scene">The scene with its bodies where they are.</param>
    /// <param name="lines">The list that is added to.</param>
    public void AddTo(LoadedScene scene, List<LineSegment> lines)
    {
        if (Level < 0)
        {
            return;
        }

        if (!ReferenceEquals(_key.Scene, scene) || _key.Level != Level)
        {
            _key = (scene, Level);
            _lines = [];
            foreach (var placed in scene.Objects)
            {
                AddObject(placed);
            }
        }

        lines.AddRange(_lines);
    }

    private void AddObject(PlacedModel placed)
    {
        if (Level > 0 && placed.Model is FractalModel { Fractal: { Description.Composition: Composition.Affine } fractal }
            && Level <= (fractal.LevelCount ?? long.MaxValue))
        {
            AddChildren(fractal, SubFractals.Of(fractal, Level).Bounds, placed.ObjectToWorld, 0);
        }
        else if (Level == 0)
        {
            Selection.AddBox(_lines, placed.Model.Bounds, placed.ObjectToWorld, LineColour);
        }
    }

    private void AddChildren(Fractal fractal, BoundingBox box, AffineMap map, int level)
    {
        if (level == Level)
        {
            Selection.AddBox(_lines, box, map, LineColour);
            return;
        }

        foreach (var child in fractal.LevelAt(level).Maps)
        {
            if (_lines.Count >= Selection.LinesPerBox * MaxBoxes)
            {
                return;
            }

            AddChildren(fractal, box, map * child, level + 1);
        }
    }
}
