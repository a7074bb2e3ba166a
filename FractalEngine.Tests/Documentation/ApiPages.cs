using System.Globalization;
using System.Reflection;
using System.Runtime.CompilerServices;
using System.Text;
using System.Text.RegularExpressions;
using System.Xml.Linq;

namespace FractalEngine.Tests.Documentation;

/// <summary>The pages of docs/api: public types and members of the assemblies, with what their XML documentation says.</summary>
internal static partial class ApiPages
{
    /// <summary>Makes a page for each namespace of an assembly.</summary>
    /// <param name="assembly">With its XML documentation beside it.</param>
    /// <returns>The names of the pages, without ending, and their texts.</returns>
    public static IEnumerable<(string Name, string Text)> Of(Assembly assembly)
    {
        var summaries = XDocument.Load(Path.ChangeExtension(assembly.Location, ".xml")).Descendants("member")
            .ToDictionary(member => member.Attribute("name")!.Value, Documentation.Of);
        return from type in assembly.GetExportedTypes()
               where !type.IsSpecialName
               group type by type.Namespace into types
               orderby types.Key
               select (types.Key!, Page(types.Key!, types.OrderBy(ApiSignatures.NameOf, StringComparer.Ordinal), summaries));
    }

    private static string Page(string name, IEnumerable<Type> types, Dictionary<string, Documentation> summaries)
    {
        var text =
            new StringBuilder($"# {name}\n\nThe public types of this namespace, made from the assembly and its XML documentation.\n");
        foreach (var type in types)
        {
            text.Append(CultureInfo.InvariantCulture, $"\n## {ApiSignatures.NameOf(type)}\n\n");
            AppendWrapped(text, "", Find(summaries, type).Summary);
            text.Append(CultureInfo.InvariantCulture, $"\n```csharp\n{ApiSignatures.Of(type)}\n```\n\n");
            AppendMembers(text, type, summaries);
        }

        return text.ToString();
    }

    private static void AppendMembers(StringBuilder text, Type type, Dictionary<string, Documentation> summaries)
    {
        var nullability = new NullabilityInfoContext();
        foreach (var member in Members(type))
        {
            if (type.IsEnum)
            {
                AppendWrapped(text, $"- `{member.Name}`: ", Find(summaries, member).Summary);
                continue;
            }

            var documentation = Find(summaries, member);
            var summary = documentation.Summary;
            AppendWrapped(text, $"- `{ApiSignatures.Of(member, nullability)}`", summary.Length == 0 ? "" : $"\n{summary}");
            foreach (var note in documentation.Notes)
            {
                AppendWrapped(text, "  - ", note);
            }
        }
    }

    /// <summary>The members that a type declares itself and that nobody generated, in the order of their names and kinds.</summary>
    private static IEnumerable<MemberInfo> Members(Type type)
    {
        const BindingFlags Declared =
            BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.Instance | BindingFlags.Static | BindingFlags.DeclaredOnly;
        return type.GetMembers(Declared)
            .Where(member => IsVisible(member) && !member.IsDefined(typeof(CompilerGeneratedAttribute)) && !IsImplied(type, member))
            .OrderBy(member => member switch { ConstructorInfo => 0, FieldInfo => 1, PropertyInfo => 2, _ => 3 })
            .ThenBy(member => type.IsEnum ? member.MetadataToken : 0)
            .ThenBy(member => member.Name, StringComparer.Ordinal).ThenBy(DocumentationId, StringComparer.Ordinal);
    }

    private static bool IsVisible(MemberInfo member) => member switch
    {
        MethodBase method => (method.IsPublic || method.IsFamily) && (!method.IsSpecialName || method is ConstructorInfo
            || method.Name.StartsWith("op_", StringComparison.Ordinal)),
        PropertyInfo property => property.GetMethod is { IsPublic: true },
        FieldInfo field => field.IsPublic && !field.IsSpecialName,
        EventInfo => true,
        _ => false,
    };

    /// <summary>
    /// Equality, hashes and texts are no news; nor is what a record or an exception has by itself. The signature of a type tells of its
    /// <c>Dispose</c>.
    /// </summary>
    private static bool IsImplied(Type type, MemberInfo member) =>
        member.Name is "Equals" or "GetHashCode" or "ToString" or "Deconstruct" or "op_Equality" or "op_Inequality" or "Dispose"
        || (member is ConstructorInfo && (type.IsAbstract || typeof(Exception).IsAssignableFrom(type)))
        || typeof(Delegate).IsAssignableFrom(type);

    private static Documentation Find(Dictionary<string, Documentation> documentation, MemberInfo member) =>
        documentation.GetValueOrDefault(DocumentationId(member), Documentation.None);

    /// <summary>The identifier that the compiler gives a type or member in XML documentation.</summary>
    private static string DocumentationId(MemberInfo member)
    {
        if (member is Type type)
        {
            return "T:" + Encode(type);
        }

        var owner = Encode(member.DeclaringType!);
        return member switch
        {
            ConstructorInfo constructor => $"M:{owner}.#ctor{Parameters(constructor)}",
            MethodInfo method => $"M:{owner}.{method.Name}{(method.IsGenericMethod ? $"``{method.GetGenericArguments().Length}" : "")}"
                + Parameters(method) + (method.Name is "op_Implicit" or "op_Explicit" ? "~" + Encode(method.ReturnType) : ""),
            PropertyInfo property => $"P:{owner}.{property.Name}" + (property.GetIndexParameters() is { Length: > 0 } indices
                ? $"({string.Join(',', indices.Select(index => Encode(index.ParameterType)))})" : ""),
            FieldInfo field => $"F:{owner}.{field.Name}",
            _ => $"E:{owner}.{member.Name}",
        };
    }

    private static string Parameters(MethodBase method) => method.GetParameters() is { Length: > 0 } parameters
        ? $"({string.Join(',', parameters.Select(parameter => Encode(parameter.ParameterType)))})"
        : "";

    private static string Encode(Type type)
    {
        if (type.IsByRef)
        {
            return Encode(type.GetElementType()!) + "@";
        }

        if (type.IsArray)
        {
            return Encode(type.GetElementType()!) + "[]";
        }

        if (type.IsGenericParameter)
        {
            return (type.DeclaringMethod is null ? "`" : "``") + type.GenericParameterPosition;
        }

        if (type is { IsGenericType: true, IsGenericTypeDefinition: false })
        {
            var name = (type.IsNested ? Encode(type.DeclaringType!) : type.Namespace) + "." + type.Name.Split('`')[0];
            return $"{name}{{{string.Join(',', type.GetGenericArguments().Select(Encode))}}}";
        }

        return (type.FullName ?? type.Name).Replace('+', '.');
    }

    /// <summary>The text of a summary: one line, names in backquotes.</summary>
    private static string Plain(XElement? element)
    {
        var text = string.Concat((element?.Nodes() ?? []).Select(node => node switch
        {
            XText plain => plain.Value,
            XElement { Name.LocalName: "see" or "paramref" or "typeparamref" } reference =>
                $"`{ShortName(Target(reference).Split('(')[0])}`",
            XElement { Name.LocalName: "c" } code => $"`{code.Value}`",
            XElement inner => inner.Value,
            _ => "",
        }));
        return Blanks().Replace(text, " ").Trim();
    }

    /// <summary>The name of a type, or that of a member with its type.</summary>
    private static string ShortName(string id)
    {
        var parts = id.Split('.', ':');
        return id.Length > 2 && id[1] == ':' && id[0] != 'T' && parts.Length > 1 ? $"{parts[^2]}.{parts[^1]}" : parts[^1];
    }

    private static string Target(XElement reference) =>
        (reference.Attribute("cref") ?? reference.Attribute("name") ?? reference.Attribute("langword"))?.Value ?? "";

    /// <summary>Appends text in lines of at most 120 columns; signatures stay whole.</summary>
    private static void AppendWrapped(StringBuilder text, string head, string body)
    {
        text.Append(head);
        var column = head.Length;
        var indent = head.TrimStart().StartsWith("- ", StringComparison.Ordinal)
            ? new string(' ', head.IndexOf('-', StringComparison.Ordinal) + 2)
            : "";
        if (body.StartsWith('\n'))
        {
            text.Append('\n').Append(indent);
            column = indent.Length;
            body = body[1..];
        }

        var isFirst = true;
        foreach (var word in body.Split(' ', StringSplitOptions.RemoveEmptyEntries))
        {
            if (!isFirst && column + 1 + word.Length > 120)
            {
                text.Append('\n').Append(indent);
                column = indent.Length;
            }
            else if (!isFirst)
            {
                text.Append(' ');
                column++;
            }

            text.Append(word);
            column += word.Length;
            isFirst = false;
        }

        text.Append('\n');
    }

    /// <summary>What the XML documentation says of a type or member.</summary>
    /// <param name="Summary">The summary on one line.</param>
    /// <param name="Notes">A line for each parameter, the result and each exception that it describes.</param>
    private sealed record Documentation(string Summary, IReadOnlyList<string> Notes)
    {
        public static Documentation None { get; } = new("", []);

        public static Documentation Of(XElement member) => new(Plain(member.Element("summary")),
        [
            .. member.Elements("param").Where(HasText).Select(note => $"`{note.Attribute("name")!.Value}`: {Plain(note)}"),
            .. member.Elements("returns").Where(HasText).Select(note => $"Returns: {Plain(note)}"),
            .. member.Elements("exception").Where(HasText).Select(note => $"`{ShortName(Target(note))}`: {Plain(note)}"),
        ]);

        private static bool HasText(XElement note) => Plain(note).Length > 0;
    }

    [GeneratedRegex(@"\s+")]
    private static partial Regex Blanks();
}
