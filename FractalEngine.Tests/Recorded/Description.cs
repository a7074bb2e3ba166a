using System.Collections;
using System.Collections.Immutable;
using System.Globalization;
using System.Reflection;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Recorded;

/// <summary>Writes what an object holds on one line: the values that are stored, not those that follow from them.</summary>
internal static class Description
{
    private const int MaxItems = 40;
    private const int MaxNumbers = 16;
    private const int MaxDepth = 12;

    // What follows from other values, and what differs from machine to machine.
    private static readonly string[] LeftOut = ["LocalAxes", "LocalAxesInverse", "ThreadCount"];

    /// <summary>Describes a value. What is null, false, 0 or empty in an object is left out.</summary>
    public static string Of(object? value, int depth = 0) => value switch
    {
        null => "-",
        string text => $"'{text.Replace("\n", "⏎", StringComparison.Ordinal)}'",
        double number => RecordedText.Text(number),
        float number => RecordedText.Text(number),
        bool or Enum or IFormattable => string.Create(CultureInfo.InvariantCulture, $"{value}"),
        Vector vector => $"({RecordedText.Text(vector.X)}, {RecordedText.Text(vector.Y)}, {RecordedText.Text(vector.Z)})",
        _ when IsDefaultArray(value) => "default",
        IDictionary map => "{" + string.Join(", ", map.Keys.Cast<object>().Select(key => $"{Of(key, depth + 1)}: {Of(map[key], depth + 1)}")
            .Order(StringComparer.Ordinal)) + "}",
        IEnumerable items => OfItems([.. items.Cast<object?>()], depth),
        _ when depth > MaxDepth => value.GetType().Name,
        _ => $"{value.GetType().Name}{{{string.Join(" ", Members(value).Select(member => Of(member, value, depth)).OfType<string>())}}}",
    };

    /// <summary>Describes numbers by their count, their sum and their sum weighted by their places.</summary>
    public static string OfNumbers(IReadOnlyCollection<double> numbers)
    {
        double sum = numbers.Sum();
        double weighted = numbers.Select((number, i) => number * (1 + (i % 101))).Sum();
        return $"[{numbers.Count}: {RecordedText.Text(sum)} {RecordedText.Text(weighted)}]";
    }

    private static string OfItems(object?[] items, int depth)
    {
        if (items.Length > MaxNumbers && items[0] is double or float or int or long or byte)
        {
            return OfNumbers([.. items.Select(item => Convert.ToDouble(item, CultureInfo.InvariantCulture))]);
        }

        string rest = items.Length > MaxItems ? $", … {items.Length}" : "";
        return "[" + string.Join(", ", items.Take(MaxItems).Select(item => Of(item, depth + 1))) + rest + "]";
    }

    private static string? Of(MemberInfo member, object value, int depth)
    {
        object? content = member is PropertyInfo property ? property.GetValue(value) : ((FieldInfo)member).GetValue(value);
        return IsNothing(content) ? null : $"{member.Name}={Of(content, depth + 1)}";
    }

    private static bool IsNothing(object? content) => content switch
    {
        null => true,
        ICollection { Count: 0 } when !IsDefaultArray(content) => true,
        Delegate or Type => true,
        ValueType when content is not Vector => content.Equals(Activator.CreateInstance(content.GetType())),
        _ => false,
    };

    private static bool IsDefaultArray(object value) => value.GetType() is { IsGenericType: true } type
        && type.GetGenericTypeDefinition() == typeof(ImmutableArray<>) && (bool)type.GetProperty("IsDefault")!.GetValue(value)!;

    // Properties with a field behind them, and public fields, such as those of tuples.
    private static IEnumerable<MemberInfo> Members(object value)
    {
        const BindingFlags Public = BindingFlags.Public | BindingFlags.Instance;
        var type = value.GetType();
        return type.GetProperties(Public).Where(property => property.GetIndexParameters().Length == 0 && IsStored(property))
            .Cast<MemberInfo>().Concat(type.GetFields(Public));
    }

    private static bool IsStored(PropertyInfo property) => !LeftOut.Contains(property.Name)
        && (HasField(property, $"<{property.Name}>k__BackingField")
            || HasField(property, $"_{char.ToLowerInvariant(property.Name[0])}{property.Name[1..]}"));

    private static bool HasField(PropertyInfo property, string name) =>
        property.DeclaringType!.GetField(name, BindingFlags.NonPublic | BindingFlags.Instance) is not null;
}
