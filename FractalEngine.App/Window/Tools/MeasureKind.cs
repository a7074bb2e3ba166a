namespace FractalEngine.App.Window.Tools;

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
