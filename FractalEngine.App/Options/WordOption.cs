using System.CommandLine;
using System.CommandLine.Parsing;

namespace FractalEngine.App.Options;

/// <summary>Creates options whose value is one of a few words.</summary>
internal static class WordOption
{
    /// <summary>Creates an option that takes one word.</summary>
    /// <param name="name">The name with its dashes.</param>
    /// <param name="description">The sentence in the help text, which lists the words by itself.</param>
    /// <param name="words">The words with their values.</param>
    public static Option<T?> Single<T>(string name, string description, params (string Word, T Value)[] words)
        where T : struct => new(name)
        {
            Description = description,
            HelpName = Join(words, "|"),
            CustomParser = result => Parse(result, name, words),
        };

    // A loop: queries over such pairs would be compiled for each type at every start.
    private static string Join<T>((string Word, T Value)[] words, string separator)
    {
        var names = new string[words.Length];
        for (var i = 0; i < names.Length; i++)
        {
            names[i] = words[i].Word;
        }

        return string.Join(separator, names);
    }

    private static T? Parse<T>(ArgumentResult result, string name, (string Word, T Value)[] words)
        where T : struct
    {
        var word = result.Tokens[0].Value;
        var index = Array.FindIndex(words, known => known.Word == word);
        if (index >= 0)
        {
            return words[index].Value;
        }

        result.AddError($"{name}: expected one of {Join(words, ", ")}, not '{word}'");
        return null;
    }
}
