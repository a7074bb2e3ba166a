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

    /// <summary>Writes a type with its kind and what it inherits.</summary>
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
        var bases = type.BaseType is { } parent && !type.IsValueType && parent != typeof(object) && kind != "delegate"
            ? $" : {NameOf(parent)}"
            : "";
        return $"{modifiers}{kind} {NameOf(type)}{bases}";
    }

    /// <summary>Writes a member without the modifiers that all public members share.</summary>
    public static string Of(MemberInfo member, NullabilityInfoContext nullability) => member switch
    {
        ConstructorInfo constructor => $"new {NameOf(constructor.DeclaringType!)}({Parameters(constructor, nullability)})",
        MethodInfo method => $"{Static(method)}{Abstract(method)}{TypeOf(nullability.Create(method.ReturnParameter), method.ReturnType)} "
            + $"{NameOf(method)}({Parameters(method, nullability)})",
        PropertyInfo property => $"{Static(property.GetMethod!)}{TypeOf(nullability.Create(property), property.PropertyType)} "
            + $"{NameOf(property, nullability)} {{ {Accessors(property)} }}",
        FieldInfo { IsLiteral: true } constant => $"const {NameOf(constant.FieldType)} {constant.Name} = {Literal(constant.GetRawConstantValue())}",
        FieldInfo field => $"{(field.IsStatic ? "static " : "")}{TypeOf(nullability.Create(field), field.FieldType)} {field.Name}",
        EventInfo @event => $"event {NameOf(@event.EventHandlerType!)} {@event.Name}",
        _ => member.Name,
    };

    /// <summary>Writes the name of a type with its type arguments.</summary>
    public static string NameOf(Type type)
    {
        if (Keywords.TryGetValue(type, out var keyword))
        {
            return keyword;
        }

        if (Nullable.GetUnderlyingType(type) is { } underlying)
        {
            return NameOf(underlying) + "?";
        }

        if (type.IsArray)
        {
            return NameOf(type.GetElementType()!) + "[]";
        }

        if (type.IsByRef)
        {
            return NameOf(type.GetElementType()!);
        }

        var outer = type is { IsNested: true, IsGenericParameter: false } ? NameOf(type.DeclaringType!) + "." : "";
        if (!type.IsGenericType)
        {
            return outer + type.Name;
        }

        var arguments = type.GetGenericArguments();
        return type.Name.StartsWith("ValueTuple", StringComparison.Ordinal)
            ? $"({string.Join(", ", arguments.Select(NameOf))})"
            : $"{outer}{type.Name.Split('`')[0]}<{string.Join(", ", arguments.Select(NameOf))}>";
    }

    private static string NameOf(MethodInfo method)
    {
        var name = method.Name.StartsWith("op_", StringComparison.Ordinal) ? "operator " + method.Name[3..] : method.Name;
        return method.IsGenericMethod ? $"{name}<{string.Join(", ", method.GetGenericArguments().Select(NameOf))}>" : name;
    }

    private static string NameOf(PropertyInfo property, NullabilityInfoContext nullability) => property.GetIndexParameters() is { Length: > 0 } indices
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
        return $"{modifier}{TypeOf(nullability.Create(parameter), parameter.ParameterType)} {parameter.Name}{value}";
    }

    private static string Default(ParameterInfo parameter) => parameter.DefaultValue is null && parameter.ParameterType.IsValueType
        ? Nullable.GetUnderlyingType(parameter.ParameterType) is null ? "default" : "null"
        : parameter.ParameterType.IsEnum ? $"{parameter.ParameterType.Name}.{Enum.ToObject(parameter.ParameterType, parameter.DefaultValue!)}"
        : Literal(parameter.DefaultValue);

    private static string Literal(object? value) => value switch
    {
        null => "null",
        string text => $"\"{text}\"",
        bool truth => truth ? "true" : "false",
        double.PositiveInfinity => "∞",
        IFormattable number => number.ToString(null, CultureInfo.InvariantCulture),
        _ => value.ToString()!,
    };

    private static string TypeOf(NullabilityInfo nullability, Type type) =>
        NameOf(type) + (nullability.ReadState == NullabilityState.Nullable && !type.IsValueType && !type.IsByRef
            || type.IsByRef && nullability.ReadState == NullabilityState.Nullable && !type.GetElementType()!.IsValueType ? "?" : "");

    private static bool IsRecord(Type type) => type.GetMethod("PrintMembers", BindingFlags.Instance | BindingFlags.NonPublic) is not null;
}
