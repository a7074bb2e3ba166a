using System.Reflection;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Documentation;

/// <summary>
/// docs/api is a snapshot of the public surface, so that a change of it is seen in review. Where it is meant, rewrite the pages:
/// <c>REWRITE_DOCS=1 dotnet test FractalEngine.Tests --filter ApiPagesTests</c>.
/// </summary>
public class ApiPagesTests
{
    private static readonly string Folder = Repository.Full("docs/api");

    [Theory]
    [InlineData("FractalEngine.Core")]
    [InlineData("FractalEngine.Parsing")]
    [InlineData("FractalEngine.Render")]
    public void Pages_OfAnAssembly_AreItsPublicSurface(string assembly)
    {
        var pages = ApiPages.Of(Assembly.Load(assembly)).ToDictionary(page => page.Name, page => page.Text);
        var stale = Directory.GetFiles(Folder, "*.md").Select(file => Path.GetFileNameWithoutExtension(file))
            .Where(name => (name == assembly || name.StartsWith(assembly + '.', StringComparison.Ordinal)) && !pages.ContainsKey(name))
            .ToArray();
        if (Environment.GetEnvironmentVariable("REWRITE_DOCS") is "1")
        {
            Array.ForEach(stale, name => File.Delete(Path.Combine(Folder, name + ".md")));
            foreach (var (name, text) in pages)
            {
                File.WriteAllText(Path.Combine(Folder, name + ".md"), text);
            }

            return;
        }

        Assert.Empty(stale);
        Assert.NotEmpty(pages);
        Assert.All(pages, page => Assert.Equal(page.Value, File.ReadAllText(Path.Combine(Folder, page.Key + ".md"))));
    }
}
