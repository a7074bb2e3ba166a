using System.Collections;
using System.Runtime.CompilerServices;

namespace FractalEngine.Tests.Support;

/// <summary>Writes all properties of a value, down to the bits of every number. So −0 differs from 0, unlike with ==.</summary>
internal static class Bits
{
    public static string Of(object? value) => string.Join(' ', Leaves(value));

    private static IEnumerable<string> Leaves(object? value) => value switch
    {
        null => ["null"],
        double number => [$"{BitConverter.DoubleToInt64Bits(number):X}"],
        string or Enum or int or bool => [$"'{value}'"],
        ITuple tuple => Enumerable.Range(0, tuple.Length).SelectMany(i => Leaves(tuple[i])),
        IEnumerable items => items.Cast<object>().SelectMany(Leaves).Prepend("[").Append("]"),
        _ => value.GetType().GetProperties().Where(property => !property.GetMethod!.IsStatic)
            .SelectMany(property => Leaves(property.GetValue(value))).Prepend(value.GetType().Name),
    };
}
