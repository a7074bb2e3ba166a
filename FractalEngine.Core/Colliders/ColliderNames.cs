using System.Collections.Immutable;
using System.Text.Json;

namespace FractalEngine.Core.Colliders;

/// <summary>The names of colliders in scene files, on the command line and in messages.</summary>
public static class ColliderNames
{
    /// <summary>All kinds with their names, in the order in which lists show them.</summary>
    public static ImmutableArray<(ColliderKind Kind, string Name)> All { get; } =
        [.. Enum.GetValues<ColliderKind>().Select(static kind => (kind, JsonNamingPolicy.KebabCaseLower.ConvertName(kind.ToString())))];

    /// <summary>Returns the name of a kind.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There is no such kind.</exception>
    public static string Of(ColliderKind kind) => All.FirstOrDefault(known => known.Kind == kind).Name
        ?? throw new ArgumentOutOfRangeException(nameof(kind), kind, "expected one of the kinds of colliders");
}
