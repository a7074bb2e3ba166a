using System.Globalization;
using System.Reflection;
using System.Runtime.CompilerServices;

namespace FractalEngine.Tests.Documentation;

/// <summary>Writes public types and members as C# declares them, as far as a reader of an API page needs it.</summary>
internal static class ApiSignatures
{
    private static readonly Dictionary<Type, string> Keywords = new()
    {
        [typeof(void)] = "void", [typeof(bool)] = "bool", [typeof(byte)] = "byte", [typeof(int)] = "int", [typeof(uint)] = "uint",
        [typeof(long)] = "long", [typeof(ulong)] = "ulong", [typeof(float)] = "float", [typeof(double)] = "double",
        [typeof(char)] = "char", [typeof(string)] = "string", [typeof(object)] = "object",
    };

    /// <summary>Writes a type with its kind, what it inherits, and <see cref="IDisposable"/> where it has that itself.</summary>
    public static string Of(Type type)
    {
        var kind = type.IsEnum ? "enum"
            : type.IsInterface ? "interface"
            : typeof(Delegate).IsAssignableFrom(type) ? "delegate"
            : type.IsValueType ? IsRecord(type) ? "readonly record struct" : "struct"
            : IsRecord(type) ? "record" : "class";
        var modifiers = type is { IsAbstract: true, IsSealed: true } ? "static "
            : type is { IsAbstract: true, IsInterface: false } ? "abstract "
            : type is { IsSealed: true, IsClass: true } && kind != "delegate" ? "sealed " : "";
        List<string> bases = [];
        if (type.BaseType is { } parent && !type.IsValueType && parent != typeof(object) && kind != "delegate")
        {
            bases.Add(NameOf(parent));
        }

        if (typeof(IDisposable).IsAssignableFrom(type) && !typeof(IDisposable).IsAssignableFrom(type.BaseType))
        {
            bases.Add(nameof(IDisposable));
        }

        return $"{modifiers}{kind} {NameOf(type)}{(bases.Count > 0 ? $" : {string.Join(", ", bases)}" : "")}";
    }

    /// <summary>Writes a member without the modifiers that all public members share.</summary>
    public static string Of(MemberInfo member, NullabilityInfoContext nullability) => member switch
    {
        ConstructorInfo constructor => $"new {NameOf(constructor.DeclaringType!)}({Parameters(constructor, nullability)})",
        MethodInfo method => $"{Static(method)}{Abstract(method)}"
            + $"{TypeOf(nullability.Create(method.ReturnParameter), method.ReturnType, method.ReturnParameter)} "
            + $"{NameOf(method)}({Parameters(method, nullability)})",
        PropertyInfo property => $"{Static(property.GetMethod!)}{TypeOf(nullability.Create(property), property.PropertyType, property)} "
            + $"{NameOf(property, nullability)} {{ {Accessors(property)} }}",
        FieldInfo { IsLiteral: true } constant =>
            $"const {NameOf(constant.FieldType)} {constant.Name} = {Literal(constant.GetRawConstantValue())}",
        FieldInfo field => $"{(field.IsStatic ? "static " : "")}{TypeOf(nullability.Create(field), field.FieldType, field)} {field.Name}",
        EventInfo @event => $"event {NameOf(@event.EventHandlerType!)} {@event.Name}",
        _ => member.Name,
    };

    /// <summary>Writes the name of a type with its type arguments.</summary>
    public static string NameOf(Type type) => NameOf(type, new());

    /// <summary>Writes the name of a type, and takes the names of tuple elements from a queue until that is empty.</summary>
    private static string NameOf(Type type, Queue<string?> elementNames)
    {
        if (Keywords.TryGetValue(type, out var keyword))
        {
            return keyword;
        }

        if (Nullable.GetUnderlyingType(type) is { } underlying)
        {
            return NameOf(underlying, elementNames) + "?";
        }

        if (type.IsArray)
        {
            return NameOf(type.GetElementType()!, elementNames) + "[]";
        }

        if (type.IsByRef)
        {
            return NameOf(type.GetElementType()!, elementNames);
        }

        var outer = type is { IsNested: true, IsGenericParameter: false } ? NameOf(type.DeclaringType!) + "." : "";
        if (!type.IsGenericType)
        {
            return outer + type.Name;
        }

        var arguments = type.GetGenericArguments();
        if (!type.Name.StartsWith("ValueTuple", StringComparison.Ordinal))
        {
            return $"{outer}{type.Name.Split('`')[0]}<{string.Join(", ", arguments.Select(argument => NameOf(argument, elementNames)))}>";
        }

        string[] ownNames = [.. arguments.Select(_ => elementNames.TryDequeue(out var name) && name is not null ? $" {name}" : "")];
        return $"({string.Join(", ", arguments.Select((argument, i) => NameOf(argument, elementNames) + ownNames[i]))})";
    }

    private static string NameOf(MethodInfo method)
    {
        var name = method.Name.StartsWith("op_", StringComparison.Ordinal) ? "operator " + method.Name[3..] : method.Name;
        return method.IsGenericMethod ? $"{name}<{string.Join(", ", method.GetGenericArguments().Select(NameOf))}>" : name;
    }

    private static string NameOf(PropertyInfo property, NullabilityInfoContext nullability) =>
        property.GetIndexParameters() is { Length: > 0 } indices
        ? $"this[{string.Join(", ", indices.Select(index => Parameter(index, nullability)))}]"
        : property.Name;

    private static string Static(MethodInfo method) => method.IsStatic ? "static " : "";

    private static string Abstract(MethodInfo method) => method switch
    {
        { DeclaringType.IsInterface: true } => "",
        { IsFamily: true, IsAbstract: true } => "protected abstract ",
        { IsFamily: true } => "protected ",
        { IsAbstract: true } => "abstract ",
        _ => "",
    };

    private static string Accessors(PropertyInfo property)
    {
        var setter = property.SetMethod is { IsPublic: true } set
            ? set.ReturnParameter.GetRequiredCustomModifiers().Contains(typeof(IsExternalInit)) ? " init;" : " set;"
            : "";
        return "get;" + setter;
    }

    private static string Parameters(MethodBase method, NullabilityInfoContext nullability)
    {
        var isExtension = method.IsDefined(typeof(ExtensionAttribute));
        var parameters = method.GetParameters().Select(parameter => Parameter(parameter, nullability));
        return (isExtension ? "this " : "") + string.Join(", ", parameters);
    }

    private static string Parameter(ParameterInfo parameter, NullabilityInfoContext nullability)
    {
        var modifier = parameter switch
        {
            { IsOut: true } => "out ",
            { IsIn: true } => "in ",
            { ParameterType.IsByRef: true } => "ref ",
            _ when parameter.IsDefined(typeof(ParamArrayAttribute)) || parameter.IsDefined(typeof(ParamCollectionAttribute)) => "params ",
            _ => "",
        };
        var value = parameter.HasDefaultValue ? $" = {Default(parameter)}" : "";
        return $"{modifier}{TypeOf(nullability.Create(parameter), parameter.ParameterType, parameter)} {parameter.Name}{value}";
    }

    private static string Default(ParameterInfo parameter) => parameter.DefaultValue is null && parameter.ParameterType.IsValueType
        ? Nullable.GetUnderlyingType(parameter.ParameterType) is null ? "default" : "null"
        : parameter.ParameterType.IsEnum
        ? $"{parameter.ParameterType.Name}.{Enum.ToObject(parameter.ParameterType, parameter.DefaultValue!)}"
        : Literal(parameter.DefaultValue);

    private static string Literal(object? value) => value switch
    {
        null => "null",
        string text => $"\"{text}\"",
        bool truth => truth ? "true" : "false",
        double.PositiveInfinity => "∞",
        char character => char.IsControl(character) ? $"'\\u{(int)character:x4}'" : $"'{character}'",
        IFormattable number => number.ToString(null, CultureInfo.InvariantCulture),
        _ => value.ToString()!,
    };

    private static string TypeOf(NullabilityInfo nullability, Type type, ICustomAttributeProvider member) =>
        NameOf(type, ElementNames(member)) + (nullability.ReadState == NullabilityState.Nullable && !type.IsValueType && !type.IsByRef
            || type.IsByRef && nullability.ReadState == NullabilityState.Nullable && !type.GetElementType()!.IsValueType ? "?" : "");

    /// <summary>The names of the elements of all tuples in a type, each tuple's own before those of the tuples in it.</summary>
    private static Queue<string?> ElementNames(ICustomAttributeProvider member) =>
        new(member.GetCustomAttributes(typeof(TupleElementNamesAttribute), false) is [TupleElementNamesAttribute names]
            ? names.TransformNames
            : []);

    private static bool IsRecord(Type type) => type.GetMethod("PrintMembers", BindingFlags.Instance | BindingFlags.NonPublic) is not null;
}
