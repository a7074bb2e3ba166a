using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Lines;

/// <summary>Edges of bounding boxes as lines.</summary>
public static class BoxLines
{
    /// <summary>Maximum number of boxes of a level; those of further sub-fractals are left out.</summary>
    public const int MaxBoxes = 1000;

    private const int LinesPerBox = 12;

    /// <summary>Adds the edges of a box; none where it is empty or infinite.</summary>
    /// <param name="lines">The list that is added to.</param>
    /// <param name="box">In its own frame.</param>
    /// <param name="map">From that frame to that of the lines.</param>
    /// <param name="colour">Colour of the edges, sRGB.</param>
    public static void Add(ICollection<LineSegment> lines, BoundingBox box, in AffineMap map, Colour colour)
    {
        ArgumentNullException.ThrowIfNull(lines);
        for (var i = 0; i < 8 && !box.IsEmpty && box.Size.IsFinite(); i++)
        {
            for (var axis = 1; axis < 8; axis *= 2)
            {
                if ((i & axis) == 0)
                {
                    lines.Add(new(map * box.Corner(i), map * box.Corner(i | axis), colour));
                }
            }
        }
    }

    /// <summary>Lists the edges of the boxes of all sub-fractals at one level, world space.</summary>
    /// <param name="scene">The scene with its bodies where they are.</param>
    /// <param name="level">0 for whole objects. Deeper levels have fractals in affine composition only; one whose levels can't be
    /// bounded has its own box there.</param>
    /// <param name="colour">Colour of the edges, sRGB.</param>
    public static IReadOnlyList<LineSegment> OfLevel(LoadedScene scene, int level, Colour colour)
    {
        ArgumentNullException.ThrowIfNull(scene);
        var lines = new List<LineSegment>();
        foreach (var placed in scene.Objects)
        {
            if (level > 0 && placed.Model is FractalModel { Fractal: { Description.Composition: Composition.Affine } fractal })
            {
                try
                {
                    foreach (var (box, map) in fractal.BoxesAt(level).Take(MaxBoxes - (lines.Count / LinesPerBox)))
                    {
                        Add(lines, box, placed.ObjectToWorld * map, colour);
                    }
                }
                catch (FractalLimitException)
                {
                    // The sub-fractals of a few deep fractals have no bounds.
                    Add(lines, placed.Model.Bounds, placed.ObjectToWorld, colour);
                }
            }
            else if (level == 0)
            {
                Add(lines, placed.Model.Bounds, placed.ObjectToWorld, colour);
            }
        }

        return lines;
    }
}
