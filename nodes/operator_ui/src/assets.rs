//! The files of the page, embedded as they are: no build step, nothing fetched from elsewhere.

/// One file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Asset {
    /// Where it is served.
    pub path: &'static str,
    /// Its media type.
    pub media_type: &'static str,
    /// What is in it.
    pub body: &'static str,
}

const HTML: &str = "text/html; charset=utf-8";
const CSS: &str = "text/css; charset=utf-8";
const JS: &str = "text/javascript; charset=utf-8";
const SVG: &str = "image/svg+xml";

/// Every file.
pub(crate) const ASSETS: [Asset; 33] = [
    Asset { path: "/", media_type: HTML, body: include_str!("../page/index.html") },
    Asset { path: "/style.css", media_type: CSS, body: include_str!("../page/style.css") },
    Asset { path: "/icon.svg", media_type: SVG, body: include_str!("../page/icon.svg") },
    Asset { path: "/main.js", media_type: JS, body: include_str!("../page/main.js") },
    Asset { path: "/link.js", media_type: JS, body: include_str!("../page/link.js") },
    Asset { path: "/pair.js", media_type: JS, body: include_str!("../page/pair.js") },
    Asset { path: "/table.js", media_type: JS, body: include_str!("../page/table.js") },
    Asset { path: "/drawing.js", media_type: JS, body: include_str!("../page/drawing.js") },
    Asset { path: "/geometry.js", media_type: JS, body: include_str!("../page/geometry.js") },
    Asset { path: "/maps.js", media_type: JS, body: include_str!("../page/maps.js") },
    Asset { path: "/answers.js", media_type: JS, body: include_str!("../page/answers.js") },
    Asset { path: "/trend.js", media_type: JS, body: include_str!("../page/trend.js") },
    Asset { path: "/receipt.js", media_type: JS, body: include_str!("../page/receipt.js") },
    Asset { path: "/world.css", media_type: CSS, body: include_str!("../page/world.css") },
    Asset { path: "/world.js", media_type: JS, body: include_str!("../page/world.js") },
    Asset { path: "/grid.js", media_type: JS, body: include_str!("../page/grid.js") },
    Asset { path: "/road.js", media_type: JS, body: include_str!("../page/road.js") },
    Asset { path: "/ask.css", media_type: CSS, body: include_str!("../page/ask.css") },
    Asset { path: "/ask.js", media_type: JS, body: include_str!("../page/ask.js") },
    Asset { path: "/carry.css", media_type: CSS, body: include_str!("../page/carry.css") },
    Asset { path: "/carry.js", media_type: JS, body: include_str!("../page/carry.js") },
    Asset { path: "/arm_view.js", media_type: JS, body: include_str!("../page/arm_view.js") },
    Asset { path: "/poses.js", media_type: JS, body: include_str!("../page/poses.js") },
    Asset { path: "/solids.js", media_type: JS, body: include_str!("../page/solids.js") },
    Asset { path: "/report.css", media_type: CSS, body: include_str!("../page/report.css") },
    Asset { path: "/report.js", media_type: JS, body: include_str!("../page/report.js") },
    Asset { path: "/session.css", media_type: CSS, body: include_str!("../page/session.css") },
    Asset { path: "/session.js", media_type: JS, body: include_str!("../page/session.js") },
    Asset { path: "/ways.js", media_type: JS, body: include_str!("../page/ways.js") },
    Asset { path: "/words.js", media_type: JS, body: include_str!("../page/words.js") },
    Asset { path: "/frontier.js", media_type: JS, body: include_str!("../page/frontier.js") },
    Asset { path: "/weights.js", media_type: JS, body: include_str!("../page/weights.js") },
    Asset { path: "/risk.js", media_type: JS, body: include_str!("../page/risk.js") },
];

#[cfg(test)]
mod tests {
    use super::ASSETS;

    #[test]
    fn every_file_of_the_page_is_served_and_refers_to_nothing_elsewhere() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/page");
        let files = std::fs::read_dir(folder).expect("the folder is there");
        let mut on_disk: Vec<String> = files
            .map(|file| format!("/{}", file.expect("it can be listed").file_name().to_string_lossy()))
            .map(|path| if path == "/index.html" { "/".into() } else { path })
            .collect();
        on_disk.sort();
        let mut served: Vec<&str> = ASSETS.iter().map(|asset| asset.path).collect();
        served.sort_unstable();
        assert_eq!(on_disk, served);
        for asset in ASSETS {
            // The SVG namespace is a name, not an address that is fetched.
            let plain = asset.body.replace("http://www.w3.org/2000/svg", "");
            assert!(!plain.contains("http://") && !plain.contains("https://"), "{}", asset.path);
        }
    }

    #[test]
    fn every_imported_module_and_every_element_id_exists() {
        let page = ASSETS[0].body;
        for asset in ASSETS.iter().filter(|asset| asset.path.ends_with(".js")) {
            for import in asset.body.split("from \"./").skip(1) {
                let name = import.split('"').next().unwrap_or_default();
                assert!(ASSETS.iter().any(|other| other.path == format!("/{name}")), "{}: {name}", asset.path);
            }
            for used in asset.body.split("$(\"").skip(1).chain(asset.body.split(" text(\"").skip(1)) {
                let id = used.split('"').next().unwrap_or_default();
                assert!(page.contains(&format!("id=\"{id}\"")), "{}: no element has the id {id}", asset.path);
            }
        }
        for id in ["table", "submit", "skip", "undo", "bound", "epsilon", "revision", "question-id", "state"] {
            assert!(page.contains(&format!("data-testid=\"{id}\"")), "{id}");
        }
    }
}
