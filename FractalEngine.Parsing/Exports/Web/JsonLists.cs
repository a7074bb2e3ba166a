using System.Text.Json;

namespace FractalEngine.Parsing.Exports.Web;

/// <summary>Writes lists and objects, which end where what is in them does.</summary>
internal static class JsonLists
{
    /// <summary>Writes a property that is a list.</summary>
    public static void WriteList<T>(this Utf8JsonWriter json, string name, IEnumerable<T> items, Action<T> write)
    {
        json.WriteStartArray(name);
        foreach (var item in items)
        {
            write(item);
        }

        json.WriteEndArray();
    }

    /// <summary>Writes a property that is a list of objects.</summary>
    public static void WriteObjects<T>(this Utf8JsonWriter json, string name, IEnumerable<T> items, Action<T> write) =>
        json.WriteList(name, items, item => json.WriteObject(null, () => write(item)));

    /// <summary>Writes an object: a property, or one in a list, which has no name.</summary>
    public static void WriteObject(this Utf8JsonWriter json, string? name, Action write)
    {
        if (name is not null)
        {
            json.WritePropertyName(name);
        }

        json.WriteStartObject();
        write();
        json.WriteEndObject();
    }

    /// <summary>Writes a property that is a list of numbers, without negative zeros.</summary>
    public static void WriteNumbers(this Utf8JsonWriter json, string name, IEnumerable<double> numbers) =>
        json.WriteList(name, numbers, number => json.WriteNumberValue(number == 0 ? 0 : number));

    /// <summary>Writes a property that is a list of three numbers.</summary>
    public static void WriteVector(this Utf8JsonWriter json, string name, Core.Maths.Vector v) => json.WriteNumbers(name, [v.X, v.Y, v.Z]);
}
