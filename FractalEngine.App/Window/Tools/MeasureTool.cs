using System.Collections.Immutable;
using FractalEngine.Core;
using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Maths;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.Tools;

/// <summary>Measures distances between what the user clicks, and keeps them until they are removed.</summary>
internal sealed class MeasureTool
{
    // Half the length of the mark at the first point, as a part of its distance from the camera.
    private const double MarkSize = 0.012;

    private LoadedScene? _scene;
    private SceneCollider? _collider;
    private Selection? _first;
    private LoadedScene? _followed;
    private bool _wasMoving;

    /// <summary>Whether clicks measure, rather than select.</summary>
    public bool IsActive { get; private set; }

    /// <summary>What the next two clicks measure.</summary>
    public MeasureKind Kind { get; set; }

    /// <summary>Whether the first of two points was clicked, and is marked.</summary>
    public bool HasFirstPoint => _first is not null;

    public ImmutableArray<Dimension> Dimensions { get; private set; } = [];

    /// <summary>What to click next, for the user.</summary>
    public string Hint => (Kind, _first) switch
    {
        (MeasureKind.Objects, null) => "click the first object",
        (_, null) => "click the first point",
        (MeasureKind.Points, _) => "click the second point",
        (MeasureKind.PointToObject, _) => "click the object",
        _ => "click the second object",
    };

    /// <summary>Begins or ends measuring.</summary>
    /// <returns>A message for the user.</returns>
    public string Toggle()
    {
        IsActive = !IsActive;
        _first = null;
        return IsActive ? $"measuring: {Hint}" : "clicks select again";
    }

    /// <summary>Remembers the first of two clicks, and measures at the second.</summary>
    /// <param name="clicked">The face under the pointer.</param>
    /// <param name="scene">The scene with its bodies where they are.</param>
    /// <returns>A message for the user.</returns>
    public string Click(Selection clicked, LoadedScene scene)
    {
        if (_first is not { } first)
        {
            _first = clicked;
            return Hint;
        }

        _first = null;
        if (first.Viewpoint is not null || clicked.Viewpoint is not null)
        {
            return ClickDeep(first, clicked);
        }

        if (Kind == MeasureKind.Objects && first.ObjectIndex == clicked.ObjectIndex)
        {
            return "both clicks were at the same object";
        }

        var dimension = Measure(Kind, first, clicked, scene);
        Dimensions = Dimensions.Add(dimension);
        return $"{dimension.What}: {dimension.LengthText}";
    }

    /// <summary>Measures again what has moved or changed since, and removes what is no longer there.</summary>
    /// <param name="scene">The scene with its bodies where they are now.</param>
    /// <param name="isMoving">Whether bodies move: distances of whole objects wait until they stand still.</param>
    public void Follow(LoadedScene scene, bool isMoving)
    {
        if ((Dimensions.IsEmpty && _first is null) || (ReferenceEquals(scene, _followed) && isMoving == _wasMoving))
        {
            return;
        }

        (_followed, _wasMoving) = (scene, isMoving);
        _first = _first is null ? null : Continue(_first, scene);
        foreach (var dimension in Dimensions)
        {
            if (Continue(dimension.First, scene) is not { } first || Continue(dimension.Second, scene) is not { } second)
            {
                Remove(dimension);
            }
            else if ((HasMoved(dimension.First, first) || HasMoved(dimension.Second, second))
                && (dimension.Kind == MeasureKind.Points || !isMoving))
            {
                MeasureAgain(dimension, first, second, scene);
            }
        }
    }

    /// <summary>Measures a distance again, and removes it where there is none any more.</summary>
    private void MeasureAgain(Dimension dimension, Selection first, Selection second, LoadedScene scene)
    {
        try
        {
            Dimensions = Dimensions.Replace(dimension, Measure(dimension.Kind, first, second, scene));
        }
        catch (Exception exception) when (exception is FractalEngineException or InvalidOperationException)
        {
            // A number was changed so that the shape has no closest point, such as one that grows beyond all bounds.
            Remove(dimension);
        }
    }

    /// <summary>Adds lines for all distances, and for the first of two points, in the frame that is drawn.</summary>
    /// <param name="lines">The list that is added to.</param>
    /// <param name="mapOf">Maps from the frame of a viewpoint to the one that is drawn; null where that is too far away.</param>
    public void AddLines(List<LineSegment> lines, Func<FractalAddress?, Func<Vector, Vector>?> mapOf)
    {
        foreach (var dimension in Dimensions)
        {
            if (mapOf(dimension.Viewpoint) is { } map)
            {
                lines.Add(dimension.Line with { From = map(dimension.From), To = map(dimension.To) });
            }
        }

        if (_first is { Hit: { } hit } first && mapOf(first.Viewpoint) is { } mapFirst)
        {
            foreach (var axis in (ReadOnlySpan<Vector>)[Vector.I, Vector.J, Vector.K])
            {
                var arm = MarkSize * hit.Distance * axis;
                lines.Add(new(mapFirst(first.Point - arm), mapFirst(first.Point + arm), Dimension.LineColour));
            }
        }
    }

    /// <summary>Measures between points that are too deep in a fractal for world space.</summary>
    private string ClickDeep(Selection first, Selection clicked)
    {
        if (Kind != MeasureKind.Points)
        {
            return "so deep in a fractal, only points can be measured";
        }

        if (first.Viewpoint is not { } before || clicked.Viewpoint is not { } now || now.MapFrom(before) is not { } map)
        {
            return "the points are too different in depth to be measured";
        }

        var dimension = new Dimension(Kind, first, clicked, map * first.Point, clicked.Point, "two points", now);
        Dimensions = Dimensions.Add(dimension);
        return $"{dimension.What}: {dimension.LengthText}";
    }

    /// <summary>Removes a distance that was measured.</summary>
    public void Remove(Dimension dimension) => Dimensions = Dimensions.Remove(dimension);

    private static Selection? Continue(Selection selection, LoadedScene scene) =>
        selection.ObjectIndex < scene.Objects.Length ? selection.ContinueIn(scene.Objects[selection.ObjectIndex]) : null;

    private static bool HasMoved(Selection before, Selection now) =>
        before.Object.ObjectToWorld != now.Object.ObjectToWorld || !ReferenceEquals(before.Object.Model, now.Object.Model);

    private Dimension Measure(MeasureKind kind, Selection first, Selection second, LoadedScene scene)
    {
        var name = second.Object.Declaration.DisplayName;
        switch (kind)
        {
            case MeasureKind.Points:
                return new(kind, first, second, first.Point, second.Point, "two points");
            case MeasureKind.PointToObject:
                var alone = new SceneCollider(scene with { Objects = [second.Object] });
                return new(kind, first, second, first.Point, alone.FindClosest(first.Point).Point, $"point to {name}");
            default:
                if (!ReferenceEquals(scene, _scene))
                {
                    _collider = new(scene);
                    _scene = scene;
                }

                var pair = _collider!.FindClosestPair(first.ObjectIndex, second.ObjectIndex);
                return new(kind, first, second, pair.Point, pair.OtherPoint, $"{first.Object.Declaration.DisplayName} to {name}");
        }
    }
}

/// <summary>What the next two clicks measure.</summary>
internal enum MeasureKind
{
    /// <summary>The distance of two points.</summary>
    Points,

    /// <summary>The distance of a point and the object that is clicked second.</summary>
    PointToObject,

    /// <summary>The distance of two objects at their closest points.</summary>
    Objects,
}
