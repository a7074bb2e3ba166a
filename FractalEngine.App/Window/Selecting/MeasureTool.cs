using System.Collections.Immutable;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Scenes;

namespace FractalEngine.App.Window.Selecting;

/// <summary>Measures distances between what the user clicks, and keeps them until they are removed.</summary>
internal sealed class MeasureTool
{
    private LoadedScene? _scene;
    private SceneCollider? _collider;
    private Selection? _first;

    /// <summary>Whether clicks measure, rather than select.</summary>
    public bool IsActive { get; private set; }

    /// <summary>What the next two clicks measure.</summary>
    public MeasureKind Kind { get; set; }

    /// <summary>The distances that were measured.</summary>
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
        return IsActive ? $"measuring: {Hint}" : "clicks select";
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

        var dimension = Kind switch
        {
            MeasureKind.Points => new Dimension(first.Hit.Point, clicked.Hit.Point, "two points"),
            MeasureKind.PointToObject => FromPoint(first, clicked, scene),
            _ => BetweenObjects(first, clicked, scene),
        };
        Dimensions = Dimensions.Add(dimension);
        return $"{dimension.What}: {dimension.LengthText}";
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

        var dimension = new Dimension(map * first.Hit.Point, clicked.Hit.Point, "two points", now);
        Dimensions = Dimensions.Add(dimension);
        return $"{dimension.What}: {dimension.LengthText}";
    }

    /// <summary>Removes a distance that was measured.</summary>
    public void Remove(Dimension dimension) => Dimensions = Dimensions.Remove(dimension);

    private static Dimension FromPoint(Selection point, Selection clicked, LoadedScene scene)
    {
        var alone = new SceneCollider(scene with { Objects = [clicked.Object] });
        var closest = alone.FindClosest(point.Hit.Point);
        return new(point.Hit.Point, closest.Point, $"point to {clicked.Object.Declaration.DisplayName}");
    }

    private Dimension BetweenObjects(Selection first, Selection second, LoadedScene scene)
    {
        if (!ReferenceEquals(scene, _scene))
        {
            _collider = new(scene);
            _scene = scene;
        }

        var pair = _collider!.FindClosestPair(first.ObjectIndex, second.ObjectIndex);
        return new(
            pair.Point, pair.OtherPoint, $"{first.Object.Declaration.DisplayName} to {second.Object.Declaration.DisplayName}");
    }
}
